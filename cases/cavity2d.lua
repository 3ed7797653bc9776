-- Lid-driven cavity: the upper side moves to the right and drags the fluid round.
-- Expect one large vortex, and small ones in the lower corners that grow with Re (Ghia et al. 1982).
case "Lid-driven cavity"

local re = param("re", 100, "Reynolds number")
local n = param("n", 32, "cells in each direction")

mesh  { box = {{0, 0}, {1, 1}}, cells = {n, n} }
fluid { density = 1, viscosity = 1 / re }

term "continuity" {}
term "momentum" {}

boundary "*"   { u = {0, 0} }
boundary "top" { u = {1, 0} }

output { probes = { centre = {0.5, 0.5} },
         lines = { vertical   = { from = {0.5, 0}, to = {0.5, 1}, points = 129 },
                   horizontal = { from = {0, 0.5}, to = {1, 0.5}, points = 129 } },
         forces = {"top"} }
