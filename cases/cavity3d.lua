-- Lid-driven cavity in three dimensions: the upper side of a cube moves to the right.
-- Expect one vortex round the z axis, weaker than in 2D because the end walls hold it back.
case "Lid-driven cavity in 3D"

local re = param("re", 100, "Reynolds number")
local n = param("n", 8, "cells in each direction")
local shape = param("shape", "hexes", "hexes or tets")

mesh  { box = {{0, 0, 0}, {1, 1, 1}}, cells = {n, n, n}, shape = shape }
fluid { density = 1, viscosity = 1 / re }

term "continuity" {}
term "momentum" {}

boundary "*"   { u = {0, 0, 0} }
boundary "top" { u = {1, 0, 0} }

output { lines = { vertical = { from = {0.5, 0, 0.5}, to = {0.5, 1, 0.5}, points = 65 } } }
