-- A disk that moves through the mesh in an exact Stokes field that it carries along: u = W + field(x - X(t)).  The body force
-- rho du/dt makes that a solution of the unsteady equations without convection, so force and torque are the Stokes ones.
case "Disk that carries its Stokes field through the mesh"

local n = param("n", 20, "cells in each direction; D/h = 0.4 n")
local mode = param("mode", "tr", "tr: the field of a disk that moves; rot: of one that rotates")
local cfl = param("cfl", 0.2, "cells passed in a step")
local k = param("k", 10, "rho h^2 / (mu dt)")
local steps = math.max(6, math.min(24, math.floor(0.2 / (cfl / n))))
local formulation = param("formulation", "sharp", "sharp or conservative")
local scheme = param("scheme", "bdf2", "bdf1 or bdf2")
local shift = param("shift", 0, "cells that the start is shifted by")
local R, h = 0.2, 1 / n
local dt = 0.01
local rho = k * dt / h ^ 2
local W = { 0.95 * cfl * h / dt, 0.31 * cfl * h / dt }
local x0, y0 = -0.5 * W[1] * dt * steps + shift * h, -0.5 * W[2] * dt * steps + 0.37 * shift * h

local function field(x, y) -- less its value on the surface of a disk that moves
  local r2 = x * x + y * y
  if mode == "rot" then return -R * R * y / r2, R * R * x / r2 end
  return -0.5 * math.log(r2) + x * x / r2 + R * R / 2 * (1 / r2 - 2 * x * x / r2 ^ 2) - (0.5 - math.log(R)),
         x * y / r2 * (1 - R * R / r2)
end

local function velocity(x, y, t)
  local u, v = field(x - x0 - W[1] * t, y - y0 - W[2] * t)
  return W[1] + u, W[2] + v
end

-- rho du/dt.  Inside the disk it does not count.
local function force(x, y, t)
  local X, Y, e = x - x0 - W[1] * t, y - y0 - W[2] * t, 1e-3 * dt
  if X * X + Y * Y < 0.1 * R * R then return 0, 0 end
  local a, b = velocity(x, y, t + e)
  local c, d = velocity(x, y, t - e)
  return rho * (a - c) / (2 * e), rho * (b - d) / (2 * e)
end

mesh  { box = {{-0.5, -0.5}, {0.5, 0.5}}, cells = {n, n} }
fluid { density = rho, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"}, force = force }
particulate(formulation)

boundary "*" { u = velocity }
initial { u = velocity }

particle { shape = disk { radius = R }, density = 1, at = {x0, y0}, motion = "prescribed", velocity = W,
           spin = mode == "rot" and 1 or 0 }

time { scheme = scheme, step = dt, stop = steps * dt }

results(function(r)
  local list, exact = r.series[mode == "rot" and "p0.torque" or "p0.fx"], mode == "rot" and 4 * math.pi * R * R or 4 * math.pi
  local n, mean, square, most = 0, 0, 0, 0
  for i = 5, #list do -- after the start
    local e = -list[i] / exact - 1
    n, mean, square, most = n + 1, mean + e, square + e * e, math.max(most, math.abs(e))
  end
  mean = mean / n
  return { mean = mean, noise = math.sqrt(math.max(0, square / n - mean ^ 2)), most = most }
end)
