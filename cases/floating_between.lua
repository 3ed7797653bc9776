-- A disk floats between a heavy fluid and a light one above it, let go a little above its place.
-- Expect it to come to rest where it displaces its own mass (Archimedes): depth = exact_depth within 2 % of its radius.
case "Disk floating between two fluids"

local n = param("n", 16, "cells per unit of length")
local dt = param("dt", 0.05, "time step")
local stop = param("stop", 20, "end")
local rho = param("density", 1.5, "of the disk; 2 in the fluid below, 1 in that above")
local mu = param("viscosity", 0.02, "of both fluids")
local above = param("above", 0.1, "how far above its place the disk starts")
local e = param("thickness", 0.5, "of the interface, in cells")
local speed = param("speed", 0.1, "at which the interface is restored")
local R, W, level = 0.25, 2, 1

-- Area of the disk below the interface when its centre is d above it, and the d at which it displaces its mass.
local function below(d)
  local c = math.max(-1, math.min(1, d / R))
  return R ^ 2 * (math.acos(c) - c * math.sqrt(1 - c ^ 2))
end

local low, high = -R, R
for i = 1, 60 do
  local d = (low + high) / 2
  if 2 * below(d) + (math.pi * R ^ 2 - below(d)) > rho * math.pi * R ^ 2 then low = d else high = d end
end
local depth = low

mesh  { box = {{0, 0}, {W, 2}}, cells = {W * n, 2 * n} }
fluid { density = 2, viscosity = mu, gravity = {0, -1} }

term "continuity" {}
term "level_set" { density_2 = 1, viscosity_2 = mu, thickness = e / n, speed = speed }
particulate "sharp"

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = R }, density = rho, at = {W / 2, level + depth + above}, hold = {"x", "spin"} }

initial { phi = function(x, y) return 1 / (1 + math.exp((level - y) * n / e)) end }

time   { scheme = "bdf2", step = dt, stop = stop }
output { every = 1, probes = { far = {0.1, 1} } }

-- Far from the disk the interface goes up by what the disk displaces more than at the start.
results(function(r)
  local y = r.last["p0.y"]
  local risen = 0
  for i = 1, 30 do risen = (below(y - level - risen) - below(depth + above)) / W end
  return { depth = y - level - risen, exact_depth = depth, error = (y - level - risen - depth) / R,
           speed = math.abs(r.last["p0.v"]) }
end)
