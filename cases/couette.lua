-- Couette flow: fluid between a wall at rest and one that moves, periodic along it.
-- Expect the straight profile u = y, to round-off, and a shear force of mu on each wall.
case "Couette flow"

local n = param("n", 8, "cells across")
local shape = param("shape", "quads", "quads or triangles")

mesh  { box = {{0, 0}, {2, 1}}, cells = {2 * n, n}, shape = shape }
fluid { density = 1, viscosity = 0.5 }

term "continuity" {}
term "momentum" {}

boundary "bottom" { u = {0, 0} }
boundary "top"    { u = {1, 0} }
boundary { periodic = {"left", "right"} }

exact  { u = function(x, y) return y, 0 end, p = 0 }
output { forces = {"bottom", "top"} }
