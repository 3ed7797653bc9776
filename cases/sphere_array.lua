-- A simple cubic array of spheres in Stokes flow, driven by a body force: one quarter of a cell, cut by two symmetry
-- planes, periodic along the flow. Expect the drag K = F / (6 pi mu a U) of Zick and Homsy (1982): 2.008 at phi = 0.027, 2.810 at 0.064.
case "Periodic array of spheres"

local n = param("n", 12, "cells along the side of the cube")
local phi = param("phi", 0.064, "volume fraction of the spheres")
local formulation = param("formulation", "sharp", "sharp or conservative")
local a = (3 * phi / (4 * math.pi)) ^ (1 / 3)

mesh  { box = {{0, 0, 0}, {1, 0.5, 0.5}}, cells = {n, n // 2, n // 2} }
fluid { density = 1, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"}, force = {1, 0, 0} }
particulate(formulation)

boundary { periodic = {"left", "right"} }
for _, side in ipairs { "bottom", "top", "back", "front" } do
  boundary(side) { symmetry = true }
end

particle { shape = sphere { radius = a }, density = 1, at = {0.5, 0, 0}, motion = "fixed" }

results(function(r) return { K = 1 / (6 * math.pi * a * r.mean.u[1]), cells_per_diameter = 2 * a * n } end)
