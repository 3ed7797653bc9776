-- A sphere that moves along a wall at a gap of half a radius through fluid without inertia, in a box of six radii.
-- Expect a force larger than Stokes's by the wall's part (Goldman, Cox and Brenner 1967) and by that of the box.
case "Stokes flow: a sphere near a wall"

local n = param("n", 12, "cells in each direction; D/h = n / 3")
local R = 1

mesh  { box = {{-3, -3, 0}, {3, 3, 6}}, cells = {n, n, n} }
fluid { density = 1, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"} }
particulate("sharp")

boundary "*" { u = {0, 0, 0} }

particle { shape = sphere { radius = R }, density = 1, at = {0.013, 0.0091, 1.5 * R}, motion = "fixed", velocity = {1, 0, 0} }

results(function(r) return { force = -r.last["p0.fx"] / (6 * math.pi * R) } end)
