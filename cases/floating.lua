-- A body lighter than the fluid: it rises and comes to rest below the lid.
-- Expect it to mirror the falling disk, slower or faster by its density.
case "Light disk rising in a channel"

local n = param("n", 12, "cells per cm")
local dt = param("dt", 0.01, "time step, s")
local stop = param("stop", 0.9, "end, s")
local rho = param("density", 0.75, "density of the disk, g/cm^3")
local formulation = param("formulation", "sharp", "sharp or conservative")
local d, mu = 0.25, 0.1

mesh  { box = {{0, 0}, {2, 6}}, cells = {2 * n, 6 * n} }
fluid { density = 1, viscosity = mu, gravity = {0, -981} }

term "continuity" {}
term "momentum" {}
particulate(formulation)
term "contact.repulsion" { range = 0.06 }

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = d / 2 }, density = rho, at = {1, 2} }

time   { scheme = "bdf2", step = dt, stop = stop }
output { every = dt * math.ceil(stop / dt / 12 - 1e-9) }

results(function(r)
  local v, most = r.series["p0.v"], 0
  for i = 1, #v do most = math.max(most, math.abs(v[i])) end
  return { speed_max = most, x = r.last["p0.x"], y = r.last["p0.y"], omega = r.last["p0.omega"] }
end)
