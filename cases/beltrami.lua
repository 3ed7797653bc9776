-- Beltrami flow of Ethier and Steinman (1994): three-dimensional, unsteady and exact.
-- Expect errors of order 3 in h (velocity) and 2 (pressure) on hexes and tets.
case "Beltrami flow (Ethier and Steinman)"

local n = param("n", 4, "cells in each direction")
local dt = param("dt", 0.01, "time step")
local stop = param("stop", 0.05, "end")
local shape = param("shape", "hexes", "hexes or tets")

local a, d, nu = math.pi / 4, math.pi / 2, 1
local exp, sin, cos = math.exp, math.sin, math.cos

local function velocity(x, y, z, t)
  local f = -a * exp(-nu * d * d * t)
  return f * (exp(a * x) * sin(a * y + d * z) + exp(a * z) * cos(a * x + d * y)),
         f * (exp(a * y) * sin(a * z + d * x) + exp(a * x) * cos(a * y + d * z)),
         f * (exp(a * z) * sin(a * x + d * y) + exp(a * y) * cos(a * z + d * x))
end
local function pressure(x, y, z, t)
  return -a * a / 2 * exp(-2 * nu * d * d * t) *
    (exp(2 * a * x) + exp(2 * a * y) + exp(2 * a * z)
     + 2 * sin(a * x + d * y) * cos(a * z + d * x) * exp(a * (y + z))
     + 2 * sin(a * y + d * z) * cos(a * x + d * y) * exp(a * (z + x))
     + 2 * sin(a * z + d * x) * cos(a * y + d * z) * exp(a * (x + y)))
end

mesh  { box = {{-1, -1, -1}, {1, 1, 1}}, cells = {n, n, n}, shape = shape }
fluid { density = 1, viscosity = nu }

term "continuity" {}
term "momentum" {}

boundary "*" { u = velocity }

initial { u = velocity, p = pressure }
exact   { u = velocity, p = pressure }
time    { scheme = "bdf2", step = dt, stop = stop }
output  { every = stop }
