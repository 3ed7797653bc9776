-- A manufactured solution in 2D: u = curl of psi = sin(2x) sin(y + 1/2) / 2, p = cos(x + 2y).
case "Manufactured solution (2D)"

local n = param("n", 8, "cells in each direction")
local shape = param("shape", "quads", "quads or triangles")
local curved = param("curved", false, "bend the cells")
local mu = param("viscosity", 0.7, "of the fluid")
local stabilise = param("stabilise", false, "with the terms of stabilise")
local streamline = param("streamline", 0, "strength of stabilise.streamline; 0: off")
local rho = 1.3
local sin, cos, pi = math.sin, math.cos, math.pi

local function velocity(x, y) return sin(2 * x) * cos(y + 0.5) / 2, -cos(2 * x) * sin(y + 0.5) end
local function pressure(x, y) return cos(x + 2 * y) end
local function force(x, y)
  local u, v = velocity(x, y)
  local ux, uy = cos(2 * x) * cos(y + 0.5), -sin(2 * x) * sin(y + 0.5) / 2
  local vx, vy = 2 * sin(2 * x) * sin(y + 0.5), -cos(2 * x) * cos(y + 0.5)
  -- laplacian of both components is -5 times the component
  return rho * (u * ux + v * uy) + 5 * mu * u - sin(x + 2 * y), rho * (u * vx + v * vy) + 5 * mu * v - 2 * sin(x + 2 * y)
end

local function bend(x, y)
  local s = 0.08 * sin(pi * x) * sin(pi * y)
  return x + s, y - s + 0.15 * x * (1 - x)
end

if curved then
  mesh { box = {{0, 0}, {1, 1}}, cells = {n, n}, shape = shape, map = bend }
else
  mesh { box = {{0, 0}, {1, 1}}, cells = {n, n}, shape = shape }
end
fluid { density = rho, viscosity = mu }
term "continuity" {}
term "momentum" { force = force }
if stabilise then term "stabilise" {} end
if streamline > 0 then term "stabilise.streamline" { streamline = streamline, force = force } end
boundary "*" { u = velocity }
exact { u = velocity, p = pressure }
