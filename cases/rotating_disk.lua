-- A disk that turns with a given spin in a box on which the exact Stokes flow is prescribed: the torque is known.
-- Expect the torque 4 pi mu R^2 w within 7 % at D/h = 8 (n = 20) and 1.5 % at 16, and the angle w t.
case "Rotating disk, exact Stokes flow"

local n = param("n", 20, "cells in each direction; D/h = 0.4 n")
local x0, y0 = param("x0", 0.013, "centre"), param("y0", 0.0091, "centre")
local formulation = param("formulation", "sharp", "sharp or conservative")
local R, w = 0.2, 1

local function field(x, y)
  local r2 = (x - x0) ^ 2 + (y - y0) ^ 2
  return -w * R * R * (y - y0) / r2, w * R * R * (x - x0) / r2
end

mesh  { box = {{-0.5, -0.5}, {0.5, 0.5}}, cells = {n, n} }
fluid { density = 1e-6, viscosity = 1 } -- so light that the flow is steady at once

term "continuity" {}
term "momentum" { without = {"convection"} }
particulate(formulation)

boundary "*" { u = field }

particle { shape = disk { radius = R }, density = 1, at = {x0, y0}, motion = "prescribed", spin = w }

time { step = 0.1, stop = 0.5 }

results(function(r)
  return { torque = -r.last["p0.torque"] / (4 * math.pi * R * R * w), angle = r.last["p0.angle"] }
end)
