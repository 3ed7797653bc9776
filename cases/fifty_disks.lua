-- Fifty disks settle in a closed box, meet and pile up on the floor.
-- Expect no overlap and no failed step left; the bed forms after about a second.
case "Fifty disks"

local n = param("n", 16, "cells per cm")
local dt = param("dt", 0.005, "time step, s")
local steps = param("steps", 500, "time steps")
local count = param("count", 50, "disks")
local formulation = param("formulation", "sharp", "sharp or conservative")

mesh  { box = {{0, 0}, {2, 4}}, cells = {2 * n, 4 * n} }
fluid { density = 1, viscosity = 0.1, gravity = {0, -981} }

term "continuity" {}
term "momentum" {}
particulate(formulation)
term "contact.repulsion" { range = 0.05 }

boundary "*" { u = {0, 0} }

particles { n = count, shape = disk { radius = 0.1 }, density = 1.1, inside = {{0.03, 0.5}, {1.97, 3.97}}, gap = 0.02, seed = 3 }

time   { step = dt, stop = steps * dt }
output { every = dt * math.ceil(steps / 20) }

results(function(r)
  local gap = 1e9
  for i = 0, count - 1 do
    for j = 0, i - 1 do
      local a, b, c, d = r.series["p" .. i .. ".x"], r.series["p" .. i .. ".y"], r.series["p" .. j .. ".x"], r.series["p" .. j .. ".y"]
      for k = 1, #a do gap = math.min(gap, math.sqrt((a[k] - c[k]) ^ 2 + (b[k] - d[k]) ^ 2) - 0.2) end
    end
  end
  return { smallest_gap = gap / 0.2 }
end)
