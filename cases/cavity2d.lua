-- Lid-driven cavity: the upper side moves to the right and drags the fluid round.
-- Expect one large vortex, and small ones in the lower corners that grow with Re (Ghia et al. 1982). For Re = 5000 and 10000
-- (Erturk, Corke and Goekcoel 2005) take --set n=64 --set grading=1.5 --set points=201, which has the places of their tables.
case "Lid-driven cavity"

local re = param("re", 100, "Reynolds number")
local n = param("n", 32, "cells in each direction")
local grading = param("grading", 0, "0: equal cells; larger: finer at the walls, 1.5 by a factor of 5")
local points = param("points", 129, "places on each centre line")
local cells = grading ~= 0 and clustered(0, 1, n, grading) or n

mesh  { box = {{0, 0}, {1, 1}}, cells = {cells, cells} }
fluid { density = 1, viscosity = 1 / re }

term "continuity" {}
term "momentum" {}

boundary "*"   { u = {0, 0} }
boundary "top" { u = {1, 0} }

output { probes = { centre = {0.5, 0.5} },
         lines = { vertical   = { from = {0.5, 0}, to = {0.5, 1}, points = points },
                   horizontal = { from = {0, 0.5}, to = {1, 0.5}, points = points } },
         forces = {"top"} }

results(function(r) return { u_centre = r.last["centre.u"], v_centre = r.last["centre.v"], drag = r.last["top.fx"] } end)
