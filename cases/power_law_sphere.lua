-- Creeping flow of a power-law fluid past a sphere that is held, in a box whose
-- outer sides move with the stream.  The drag is X times Stokes's with the viscosity K (U/D)^(n-1).  Expect
-- (unbounded; Gu and Tanner 1985, J. Non-Newtonian Fluid Mech. 17:1) X = 1.00 for n = 1, 1.24 for 0.8, 1.382 for
-- 0.6, 1.442 for 0.4; walls add about 2.1 R/L for n = 1, and less for smaller n.  A quarter of the flow, by symmetry.
case "Sphere in a power-law fluid"

local n = param("n", 8, "cells along an edge")
local exponent = param("exponent", 0.6, "n of the power law")
local L = param("l", 20, "half of the box, in radii")
local near = param("near", 1.6, "edge of the evenly divided part, in radii")
local inner = param("inner", 5, "cells of that part")
local R, U, K = 1, 1, 1

-- even cells round the sphere, longer ones outside, the ratio such that they fit
local function ticks()
  local h, low, high = near / inner, 1, 4
  for k = 1, 80 do
    local r, sum = (low + high) / 2, 0
    for i = 1, n - inner do sum = sum + h * r ^ i end
    if sum < L - near then low = r else high = r end
  end
  local list, x, d = {}, 0, h
  for k = 0, inner do list[k + 1] = k * h end
  x = near
  for i = 1, n - inner do d = d * low; x = x + d; list[inner + i + 1] = x end
  list[n + 1] = L
  return list
end
local edge = ticks()
local both = {}
for k = n, 1, -1 do both[#both + 1] = -edge[k + 1] end
for k = 0, n do both[#both + 1] = edge[k + 1] end

mesh  { box = {{-L, 0, 0}, {L, L, L}}, cells = {both, edge, edge} }
fluid { density = 1 }

term "continuity" {}
term "momentum" { without = {"inertia", "convection"} }
term "generalised_newtonian" { law = "power_law", consistency = K, exponent = exponent, least_rate = 1e-4 }
particulate "sharp"

boundary "*"      { u = {U, 0, 0} }
boundary "back"   { symmetry = true }
boundary "bottom" { symmetry = true }

particle { shape = sphere { radius = R }, density = 1, at = {0, 0, 0}, motion = "fixed" }
solve    { continuation = { exponent = 1 } }

results(function(r)
  local stokes = 6 * math.pi * R * K * (U / (2 * R)) ^ (exponent - 1) * U
  return { drag = r.last["p0.fx"], X = 4 * r.last["p0.fx"] / stokes } -- a quarter of it is in the box
end)
