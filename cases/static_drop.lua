-- A drop at rest, a quarter of it: surface tension alone makes the pressure inside (Laplace).
-- Expect jump = 1 (the pressure inside in sigma/R) within 1 %, and a capillary number of spurious currents below 1e-3.
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

time   { scheme = "bdf2", step = dt, stop = stop }
output { probes = { inside = {0, 0}, outside = {1, 1} },
         lines = { across = { from = {0, 0}, to = {1, 0.6}, points = 201 }, axis = { from = {0, 0}, to = {1, 0}, points = 201 } } }

results(function(r)
  return { jump = (r.last["inside.p"] - r.last["outside.p"]) * R / sigma }
end)
