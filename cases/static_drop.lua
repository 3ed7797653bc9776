-- A drop at rest, a quarter of it: surface tension alone makes the pressure inside (Laplace).
-- Expect jump (the pressure inside, in sigma/R) 1 + 3.29 (e/R)^2, and currents that are none of physics (speed, in
-- sigma/mu) of 2e-3.
case "Drop at rest"

local n = param("n", 16, "cells per radius")
local dt = param("dt", 0.05, "time step")
local stop = param("stop", 1, "end")
local e = param("thickness", 0.5, "of the interface, in cells")
local sigma, R, mu = 1, 0.5, 1

mesh  { box = {{0, 0}, {1, 1}}, cells = {n / R, n / R} }
fluid { density = 1, viscosity = mu }

term "continuity" {}
term "level_set" { density_2 = 1, viscosity_2 = mu, tension = sigma, thickness = e * R / n, speed = 0.1 }

boundary "left"   { symmetry = true }
boundary "bottom" { symmetry = true }
boundary "*"      { u = {0, 0} }

initial { phi = function(x, y) return 1 / (1 + math.exp((math.sqrt(x ^ 2 + y ^ 2) - R) * n / (e * R))) end }

-- Speeds are looked at on the interface, and a cell on both sides of it.
local probes = { inside = {0, 0}, outside = {1, 1} }
for i = 0, 8 do
  for j = -1, 1 do
    local r, angle = R * (1 + j / n), i * math.pi / 16
    probes["at" .. i .. "_" .. j + 1] = {r * math.cos(angle), r * math.sin(angle)}
  end
end

time   { scheme = "bdf2", step = dt, stop = stop }
output { probes = probes }

results(function(r)
  local speed = 0
  for i = 0, 8 do
    for j = 0, 2 do
      local u, v = r.last["at" .. i .. "_" .. j .. ".u"], r.last["at" .. i .. "_" .. j .. ".v"]
      speed = math.max(speed, math.sqrt(u ^ 2 + v ^ 2))
    end
  end
  return { jump = (r.last["inside.p"] - r.last["outside.p"]) * R / sigma, speed = speed * mu / sigma }
end)
