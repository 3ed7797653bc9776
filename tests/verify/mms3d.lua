-- A manufactured solution in 3D: an ABC field (curl u = u), p = sin(x) cos(y) + z^2.
case "Manufactured solution (3D)"

local n = param("n", 4, "cells in each direction")
local shape = param("shape", "hexes", "hexes or tets")
local curved = param("curved", false, "bend the cells")
local mu, rho = 0.7, 1.3
local a, b, c = 1, 0.7, 0.4
local sin, cos, pi = math.sin, math.cos, math.pi

local function velocity(x, y, z)
  return a * sin(z) + c * cos(y), b * sin(x) + a * cos(z), c * sin(y) + b * cos(x)
end
local function pressure(x, y, z) return sin(x) * cos(y) + z * z end
local function force(x, y, z)
  local u, v, w = velocity(x, y, z)
  return rho * (v * (-c * sin(y)) + w * a * cos(z)) + mu * u + cos(x) * cos(y),
         rho * (u * b * cos(x) + w * (-a * sin(z))) + mu * v - sin(x) * sin(y),
         rho * (u * (-b * sin(x)) + v * c * cos(y)) + mu * w + 2 * z
end

local function bend(x, y, z)
  local s = 0.05 * sin(pi * x) * sin(pi * y) * sin(pi * z)
  return x + s, y - s + 0.1 * x * (1 - x), z + s + 0.08 * y * (1 - y)
end

if curved then
  mesh { box = {{0, 0, 0}, {1, 1, 1}}, cells = {n, n, n}, shape = shape, map = bend }
else
  mesh { box = {{0, 0, 0}, {1, 1, 1}}, cells = {n, n, n}, shape = shape }
end
fluid { density = rho, viscosity = mu }
term "continuity" {}
term "momentum" { force = force }
boundary "*" { u = velocity }
exact { u = velocity, p = pressure }
