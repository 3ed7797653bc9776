-- A sphere that moves through fluid at rest, held in place: the exact Stokes field is prescribed on a box round it.
-- Expect the drag 6 pi mu R U within 4 % at four cells per diameter (n = 8), within 2 % at six (n = 12).
case "Fixed sphere, exact Stokes flow"

local n = param("n", 8, "cells in each direction; D/h = n / 2")
local mode = param("mode", "tr", "tr: the sphere moves along x; rot: it rotates round z")
local x0, y0, z0 = param("x0", 0.013, "centre"), param("y0", 0.0091, "centre"), param("z0", -0.0072, "centre")
local formulation = param("formulation", "sharp", "sharp or conservative")
local shape = param("shape", "hexes", "hexes or tets")
local R = 0.25

local function field(x, y, z)
  x, y, z = x - x0, y - y0, z - z0
  local r = math.sqrt(x * x + y * y + z * z)
  if mode == "rot" then local a = (R / r) ^ 3; return -a * y, a * x, 0 end
  local a, b = 3 * R / (4 * r), R ^ 3 / (4 * r ^ 3)
  local c = (a - 3 * b) / r ^ 2
  return a + b + c * x * x, c * x * y, c * x * z
end

mesh  { box = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, cells = {n, n, n}, shape = shape }
fluid { density = 1, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"} }
particulate(formulation)

boundary "*" { u = field }

particle { shape = sphere { radius = R }, density = 1, at = {x0, y0, z0}, motion = "fixed",
           velocity = {mode == "rot" and 0 or 1, 0, 0}, spin = {0, 0, mode == "rot" and 1 or 0} }

if formulation == "sharp" then -- outside of the sphere the solution is known
  exact { u = field, p = function(x, y, z)
    x, y, z = x - x0, y - y0, z - z0
    return mode == "tr" and 1.5 * R * x / (x * x + y * y + z * z) ^ 1.5 or 0
  end }
end

results(function(r)
  return { force = -r.last["p0.fx"] / (6 * math.pi * R), torque = -r.last["p0.tz"] / (8 * math.pi * R ^ 3) }
end)
