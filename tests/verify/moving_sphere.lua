-- A sphere that rolls: it turns round z while it moves through the mesh, in the exact Stokes field that it carries along.  The body force
-- rho du/dt makes that a solution of the unsteady equations without convection.
case "Sphere that carries its Stokes field through the mesh"

local n = param("n", 8, "cells in each direction; D/h = n / 2")
local cfl = param("cfl", 0.5, "cells passed in a step")
local k = param("k", 1, "rho h^2 / (mu dt)")
local steps = param("steps", 5, "number of steps")
local R, h, dt = 0.25, 1 / n, 0.01
local rho = k * dt / h ^ 2
local W = { 0.95 * cfl * h / dt, 0.31 * cfl * h / dt, 0 }
local x0, y0, z0 = -0.5 * W[1] * dt * steps, -0.5 * W[2] * dt * steps, 0.0072

local function velocity(x, y, z, t)
  x, y, z = x - x0 - W[1] * t, y - y0 - W[2] * t, z - z0
  local a = (R * R / (x * x + y * y + z * z)) ^ 1.5
  return W[1] - a * y, W[2] + a * x, 0
end

-- rho du/dt; inside the sphere it does not count
local function force(x, y, z, t)
  local X, Y, Z = x - x0 - W[1] * t, y - y0 - W[2] * t, z - z0
  if X * X + Y * Y + Z * Z < 0.1 * R * R then return 0, 0, 0 end
  local e = 1e-3 * dt
  local a, b = velocity(x, y, z, t + e)
  local c, d = velocity(x, y, z, t - e)
  return rho * (a - c) / (2 * e), rho * (b - d) / (2 * e), 0
end

mesh  { box = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, cells = {n, n, n} }
fluid { density = rho, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"}, force = force }
particulate "sharp"

boundary "*" { u = velocity }
initial { u = velocity }

particle { shape = sphere { radius = R }, density = 1, at = {x0, y0, z0}, motion = "prescribed", velocity = W, spin = {0, 0, 1} }

time { scheme = "bdf2", step = dt, stop = steps * dt }

results(function(r)
  local list, most = r.series["p0.tz"], 0
  for i = 1, #list do most = math.max(most, math.abs(-list[i] / (8 * math.pi * R ^ 3) - 1)) end
  return { torque = -r.last["p0.tz"] / (8 * math.pi * R ^ 3), most = most }
end)
