-- A disk held in a flow whose exact Stokes solution is prescribed on the box: force and torque are known.
-- Expect the force 4 pi mu (mode = "tr") or the torque 4 pi mu R^2 w (mode = "rot") within 7 % at D/h = 8, 1.5 % at 16.
case "Fixed disk, exact Stokes flow"

local n = param("n", 20, "cells in each direction; D/h = 0.4 n")
local mode = param("mode", "tr", "tr: the disk moves along x; rot: it rotates")
local x0, y0 = param("x0", 0.013, "centre"), param("y0", 0.0091, "centre")
local shape = param("shape", "quads", "quads or triangles")
local formulation = param("formulation", "sharp", "sharp, conservative or appendix")
local alpha = param("alpha", 1e5, "of the appendix, kg/m^3/s")
local R = 0.2

local function field(x, y)
  x, y = x - x0, y - y0
  local r2 = x * x + y * y
  if mode == "rot" then return -R * R * y / r2, R * R * x / r2 end
  return -0.5 * math.log(r2) + x * x / r2 + R * R / 2 * (1 / r2 - 2 * x * x / r2 ^ 2), x * y / r2 * (1 - R * R / r2)
end

mesh  { box = {{-0.5, -0.5}, {0.5, 0.5}}, cells = {n, n}, shape = shape }
fluid { density = 1, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"} }
particulate(formulation, formulation == "appendix" and {alpha = alpha} or nil)

if formulation == "appendix" then term "continuity.pressure_smoothing" {} end -- or the pressure inside the disk is arbitrary

boundary "*" { u = field }

particle { shape = disk { radius = R }, density = 1, at = {x0, y0}, motion = "fixed",
           velocity = {mode == "rot" and 0 or 0.5 - math.log(R), 0}, spin = mode == "rot" and 1 or 0 }

if formulation == "sharp" then -- outside of the disk the solution is known
  exact { u = field, p = function(x, y) return mode == "tr" and 2 * (x - x0) / ((x - x0) ^ 2 + (y - y0) ^ 2) or 0 end }
end

output { forces = {"left", "right", "bottom", "top"} }

results(function(r)
  local box = 0 -- what the fluid does to the box is the opposite of what the disk does to the fluid
  for _, side in ipairs {"left", "right", "bottom", "top"} do box = box + r.last[side .. ".fx"] end
  return { force_on_box = box / (4 * math.pi), force = -r.last["p0.fx"] / (4 * math.pi),
           torque = -r.last["p0.torque"] / (4 * math.pi * R * R) }
end)
