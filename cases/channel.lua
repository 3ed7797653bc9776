-- Poiseuille flow between two plates, driven by the inflow profile.
-- Expect the parabola u = 4 y (1 - y), p = 8 mu (3 - x), to round-off: both lie in the spaces.
case "Poiseuille flow in a channel"

local n = param("n", 8, "cells across")
local mu = param("mu", 0.1, "viscosity")
local shape = param("shape", "quads", "quads or triangles")

mesh  { box = {{0, 0}, {3, 1}}, cells = {2 * n, n}, shape = shape }
fluid { density = 1, viscosity = mu }

term "continuity" {}
term "momentum" {}

local function profile(x, y) return 4 * y * (1 - y), 0 end

boundary "left"   { u = profile }
boundary "right"  { traction = function(x, y) return 0, mu * (4 - 8 * y) end }
boundary "bottom" { u = {0, 0} }
boundary "top"    { u = {0, 0} }

exact  { u = profile, p = function(x, y) return 8 * mu * (3 - x) end }
output { forces = {"bottom", "top"}, lines = { outlet = { from = {3, 0}, to = {3, 1}, points = 41 } } }
