-- Taylor-Green vortices in two dimensions, decaying, periodic: exact and unsteady.
-- Expect the velocity to fall with exp(-2 nu t), errors of order 3 in h and 2 in the time step.
case "Taylor-Green vortices (2D)"

local n = param("n", 16, "cells in each direction")
local dt = param("dt", 0.02, "time step")
local stop = param("stop", 0.5, "end")
local nu = param("nu", 0.1, "viscosity")
local scheme = param("scheme", "bdf2", "bdf1 or bdf2")
local shape = param("shape", "quads", "quads or triangles")

local function velocity(x, y, t)
  local a = math.exp(-2 * nu * t)
  return math.sin(x) * math.cos(y) * a, -math.cos(x) * math.sin(y) * a
end
local function pressure(x, y, t) return 0.25 * (math.cos(2 * x) + math.cos(2 * y)) * math.exp(-4 * nu * t) end

mesh  { box = {{0, 0}, {2 * math.pi, 2 * math.pi}}, cells = {n, n}, shape = shape }
fluid { density = 1, viscosity = nu }

term "continuity" {}
term "momentum" {}

boundary { periodic = {"left", "right"} }
boundary { periodic = {"bottom", "top"} }

initial { u = velocity, p = pressure }
exact   { u = velocity, p = pressure }
time    { scheme = scheme, step = dt, stop = stop }
output  { every = stop }
