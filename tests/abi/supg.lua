-- SPDX-License-Identifier: GPL-3.0-or-later
-- A scalar carried through a channel with curved cells, past a body or none, for the plugin supg.
case "Transport, stabilised by its residual"

local n = param("n", 6, "cells across")
local body = param("body", false, "a disk in the channel")
local simplex = param("simplex", false, "triangles")

mesh  { box = {{0, 0}, {2, 1}}, cells = {2 * n, n}, shape = simplex and "triangles" or "quads",
        map = function(x, y) return x + 0.04 * math.sin(5 * y), y + 0.05 * math.sin(3 * x) end }
fluid { density = 1, viscosity = 0.05 }
term "continuity" {}
term "momentum" {}
term "supg" { diffusivity = 1e-3, f = function(x, y) return x * y end }
if body then
  particulate "sharp"
  particle { shape = disk { radius = 0.17 }, density = 1, at = {0.8, 0.5}, motion = "fixed" }
end

boundary "left"  { u = {1, 0}, T = function(x, y) return y > 0.4 and 1 or 0 end }
boundary "right" { natural = true }
boundary "*"     { u = {0, 0} }
