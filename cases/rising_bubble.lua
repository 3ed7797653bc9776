-- A light bubble rises in a heavier fluid (Hysing et al. 2009, case 1); the right half of it.
-- Expect the centre of mass at y = 1.081 at t = 3, the largest rise velocity 0.2417 at t = 0.92 and the least
-- circularity 0.9013 at t = 1.90, all within 2 %.
case "Rising bubble"

local n = param("n", 40, "cells per unit of length")
local dt = param("dt", 0.02, "time step")
local stop = param("stop", 3, "end")
local e = param("thickness", 0.35, "of the interface, in cells")
local speed = param("speed", 0.1, "at which the interface is restored")

mesh  { box = {{0, 0}, {0.5, 2}}, cells = {n / 2, 2 * n} }
fluid { density = 1000, viscosity = 10, gravity = {0, -0.98} }

term "continuity" {}
term "level_set" { density_2 = 100, viscosity_2 = 1, tension = 24.5, thickness = e / n, speed = speed }
term "level_set.measures" {}

boundary "left"  { symmetry = true }
boundary "right" { symmetry = true }
boundary "*"     { u = {0, 0} }

initial { phi = function(x, y)
  return 1 / (1 + math.exp((math.sqrt(x ^ 2 + (y - 0.5) ^ 2) - 0.25) * n / e))
end }

time   { scheme = "bdf2", step = dt, stop = stop }
output { every = 0.5 }

-- The bubble by phi: centre of mass, rise velocity and circularity, the perimeter of a circle of its area over its own.
results(function(r)
  local area, moment, flow, arc = r.series.share, r.series.moment_y, r.series.flow_y, r.series.interface
  local fastest, least = { speed = 0 }, { circularity = 2 }
  for i = 1, #area do
    local speed, circularity = flow[i] / area[i], math.sqrt(math.pi * 2 * area[i]) / arc[i]
    if speed > fastest.speed then fastest = { speed = speed, t = r.t[i] } end
    if circularity < least.circularity then least = { circularity = circularity, t = r.t[i] } end
  end
  return { centre = r.last.moment_y / r.last.share, speed_max = fastest.speed, speed_max_at = fastest.t,
           circularity_min = least.circularity, circularity_min_at = least.t, area_kept = r.last.share / area[1] }
end)
