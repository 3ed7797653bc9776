-- A vortex that is carried round by a stream that turns with time, periodic: u = w(x - d(t)) e^{-2 nu t} + d'(t), an exact solution of
-- the Navier-Stokes equations for any d. All scales of time are known: d = (sin 2t, 1 - cos 2t) / 2.
case "Vortices in a stream that turns"

local n = param("n", 12, "cells in each direction")
local tolerance = param("tolerance", 1e-3, "of steps")
local dt = param("dt", 0, "length of all steps; 0: by the tolerance")
local stop = param("stop", 3, "end")
local nu = param("nu", 0.1, "viscosity")

local function d(t) return math.sin(2 * t) / 2, (1 - math.cos(2 * t)) / 2 end
local function stream(t) return math.cos(2 * t), math.sin(2 * t) end
local function velocity(x, y, t)
  local a, dx, dy, u, v = math.exp(-2 * nu * t), 0, 0, stream(t)
  dx, dy = d(t)
  return u + math.sin(x - dx) * math.cos(y - dy) * a, v - math.cos(x - dx) * math.sin(y - dy) * a
end
-- the stream is driven by a force d''(t)
local function force(x, y, t) return -2 * math.sin(2 * t), 2 * math.cos(2 * t) end

mesh  { box = {{0, 0}, {2 * math.pi, 2 * math.pi}}, cells = {n, n} }
fluid { density = 1, viscosity = nu }
term "continuity" {}
term "momentum" { force = force }
boundary { periodic = {"left", "right"} }
boundary { periodic = {"bottom", "top"} }
initial { u = velocity }
exact   { u = velocity }
if dt > 0 then time { step = dt, stop = stop } else time { tolerance = tolerance, stop = stop } end
output  { every = stop }
