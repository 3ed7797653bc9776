-- Ten heavy spheres falling to the floor of a box, from places at random: they meet each other and the walls.
-- Expect them to come to rest side by side without overlap.
case "Ten spheres in a box"

local n = param("n", 12, "cells in each direction; D/h = n / 4")
local dt = param("dt", 0.015, "time step, s")
local steps = param("steps", 50, "number of steps")
local formulation = param("formulation", "sharp", "sharp or conservative")
local R = 0.125

mesh  { box = {{0, 0, 0}, {1, 1, 1}}, cells = {n, n, n} }
fluid { density = 1, viscosity = 0.05, gravity = {0, 0, -9.81} }

term "continuity" {}
term "momentum" {}
particulate(formulation)
term "contact.repulsion" { range = 0.06 }

boundary "*" { u = {0, 0, 0} }

particles { n = 10, shape = sphere { radius = R }, density = 3, inside = {{0.05, 0.05, 0.3}, {0.95, 0.95, 0.95}}, gap = 0.01, seed = 4 }

time   { scheme = "bdf2", step = dt, stop = steps * dt }
output { every = dt * math.ceil(steps / 8) }

results(function(r)
  local gap, low = 1e9, 1e9 -- smallest distance of two surfaces, and of a surface to the floor
  for i = 0, 9 do
    local x, y, z = r.series["p" .. i .. ".x"], r.series["p" .. i .. ".y"], r.series["p" .. i .. ".z"]
    for k = 1, #x do low = math.min(low, z[k] - R) end
    for j = 0, i - 1 do
      local X, Y, Z = r.series["p" .. j .. ".x"], r.series["p" .. j .. ".y"], r.series["p" .. j .. ".z"]
      for k = 1, #x do gap = math.min(gap, math.sqrt((x[k] - X[k]) ^ 2 + (y[k] - Y[k]) ^ 2 + (z[k] - Z[k]) ^ 2) - 2 * R) end
    end
  end
  return { smallest_gap = gap, above_floor = low }
end)
