-- A neutrally buoyant ellipse of aspect ratio 2 turns in a shear flow, Stokes limit (Jeffery 1922).
-- Expect the period 2 pi (r + 1/r) / shear rate = 15.71 within a few per cent: fast when it stands across, slow when it lies along.
case "Ellipse in shear"

local m = param("m", 24, "cells over the refined middle, four semi-axes wide")
local dt = param("dt", 0.1, "time step; the shear rate is 1")
local box = param("box", 10, "half width of the box, in larger semi-axes")
local formulation = param("formulation", "sharp", "sharp or conservative")

local lines = grid { -box, 8, -2, m, 2, 8, box }
mesh  { box = {{-box, -box}, {box, box}}, cells = {lines, lines} }
fluid { density = 0.01, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"} }
particulate(formulation)

local function shear(x, y) return y, 0 end
boundary "*" { u = shear }
initial { u = shear }

particle { shape = ellipse { a = 1, b = 0.5 }, density = 0.01, at = {0.013, 0.0091}, angle = math.pi / 2, spin = -0.8 }

time   { step = dt, stop = 8.6 }
output { every = 2 }

results(function(r)
  -- half a turn from pi/2 to -pi/2 takes half a period
  local t, angle, half = r.t, r.series["p0.angle"], 0
  for i = 2, #t do
    if angle[i - 1] > -math.pi / 2 and angle[i] <= -math.pi / 2 then
      half = t[i - 1] + (t[i] - t[i - 1]) * (angle[i - 1] + math.pi / 2) / (angle[i - 1] - angle[i])
    end
  end
  local fast, slow = 0, 9
  for _, w in ipairs(r.series["p0.omega"]) do fast, slow = math.max(fast, -w), math.min(slow, -w) end
  return { period = 2 * half, fastest = fast, slowest = slow }
end)
