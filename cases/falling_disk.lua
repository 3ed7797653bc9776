-- A disk settling in a channel (Glowinski et al. 2001, case A): it accelerates, falls steadily, and comes to rest on the floor.
-- Expect the largest Reynolds number rho_P d |U| / mu between 17.1 and 17.7; --set n=32 --set dt=0.0025 is a fine run.
case "Disk settling in a channel"

local n = param("n", 12, "cells per cm")
local dt = param("dt", 0.01, "time step, s")
local tolerance = param("tolerance", 0, "of steps that choose their length; 0: all are dt")
local stop = param("stop", 0.9, "end, s")
local rho = param("density", 1.25, "density of the disk, g/cm^3")
local formulation = param("formulation", "sharp", "sharp or conservative")
local d, mu = 0.25, 0.1

mesh  { box = {{0, 0}, {2, 6}}, cells = {2 * n, 6 * n} }
fluid { density = 1, viscosity = mu, gravity = {0, -981} }

term "continuity" {}
term "momentum" {}
particulate(formulation)
term "contact.repulsion" { range = 0.06 }

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = d / 2 }, density = rho, at = {1, 4} }

local iterations = param("iterations", 0, "bodies placed anew within a step")
if tolerance > 0 then
  time { tolerance = tolerance, stop = stop }
else
  time { scheme = "bdf2", step = dt, stop = stop, geometry_iterations = iterations }
end
output { every = dt * math.ceil(stop / dt / 12 - 1e-9) }

results(function(r)
  local v, most = r.series["p0.v"], 0
  for i = 1, #v do most = math.max(most, math.abs(v[i])) end
  return { re_max = rho * d * most / mu, x = r.last["p0.x"], y = r.last["p0.y"], omega = r.last["p0.omega"] }
end)
