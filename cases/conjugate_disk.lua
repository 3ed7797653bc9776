-- A disk that conducts heat k times as well as what is round it, in a temperature that rises along x.
-- Expect the uniform slope 2/(1 + k) inside, a dipole outside, and errors of third order in the cell size.
case "Conducting disk"

local n = param("n", 16, "cells in each direction")
local k = param("k", 10, "conductivity of the disk; that of the fluid is 1")
local x0, y0 = param("x0", 0.013, "centre"), param("y0", 0.0091, "centre")
local shape = param("shape", "quads", "quads or triangles")
local R = 0.25

local function outside(x, y)
  x, y = x - x0, y - y0
  return x * (1 - (k - 1) / (k + 1) * R ^ 2 / (x ^ 2 + y ^ 2))
end

mesh  { box = {{-0.5, -0.5}, {0.5, 0.5}}, cells = {n, n}, shape = shape }
fluid { density = 1, conductivity = 1, heat_capacity = 1 }

term "heat" { without = {"advection", "buoyancy"} }
term "heat_bodies" { body_conductivity = k }

boundary "*" { T = outside }

particle { shape = disk { radius = R }, density = 1, at = {x0, y0}, motion = "fixed" }

exact  { T = outside, T_body = function(x) return 2 / (1 + k) * (x - x0) end }
output { forces = {"right"}, probes = { inside = {x0 + 0.1, y0 + 0.05} },
         lines = { middle = { from = {-0.5, y0}, to = {0.5, y0}, points = 101 } } }

-- of the probe inside, over what it should be
results(function(r)
  return { inside = r.last["inside.T_body"] / (2 / (1 + k) * 0.1) }
end)
