-- Two disks fall one above the other, fast: drafting, kissing, tumbling at Reynolds numbers of some hundreds (Glowinski et al. 2001,
-- J. Comput. Phys. 169:363; Uhlmann 2005, J. Comput. Phys. 209:448, whose small offsets from the axis these are).
-- Expect the upper disk in the wake of the lower to catch up, the pair to turn over and part: on the default mesh nearest, 0.16 d
-- apart, at 0.22 s, side by side at 0.33 s. Re goes up to 790. The wake is barely resolved, and when it tips over decides: without
-- `stabilise`, with steps of 1 ms, the disks are nearest at 0.195 s and side by side at 0.22 s. Two minutes.
case "Drafting, kissing, tumbling, fast"

local n = param("n", 16, "cells per cm")
local tolerance = param("tolerance", 1e-2, "of steps that choose their length")
local dt = param("dt", 0, "length of all steps instead, s")
local stop = param("stop", 0.4, "end, s")
local stabilise = param("stabilise", true, "terms against convection that the mesh does not resolve")
local formulation = param("formulation", "sharp", "sharp or conservative")
local d, rho, mu = 0.25, 1.5, 0.01

mesh  { box = {{0, 0}, {2, 6}}, cells = {2 * n, 6 * n} }
fluid { density = 1, viscosity = mu, gravity = {0, -981} }

term "continuity" {}
term "momentum" {}
particulate(formulation)
term "contact.repulsion" { range = 0.06, strength = 40 } -- stiff: what falls fast stays clear of the floor by half a cell
term "contact.lubrication" {}                      -- films thinner than cells
if stabilise then term "stabilise" {} end

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = d / 2 }, density = rho, at = {1.001, 5} }
particle { shape = disk { radius = d / 2 }, density = rho, at = {0.999, 4.5} }

if dt > 0 then time { step = dt, stop = stop } else time { tolerance = tolerance, stop = stop } end
output { every = stop / 20 }

results(function(r)
  local x, y, X, Y = r.series["p0.x"], r.series["p0.y"], r.series["p1.x"], r.series["p1.y"]
  local v, V, gap, kiss, most = r.series["p0.v"], r.series["p1.v"], 1e9, 0, 0
  local turned = "not within the run"
  for i = 1, #x do
    local g = math.sqrt((x[i] - X[i]) ^ 2 + (y[i] - Y[i]) ^ 2) - d
    if g < gap then gap, kiss = g, r.t[i] end
    if y[i] < Y[i] and type(turned) == "string" then turned = r.t[i] end
    most = math.max(most, math.abs(v[i]), math.abs(V[i]))
  end
  return { smallest_gap = gap / d, at = kiss, turned_over = turned, re_max = rho * d * most / mu,
           dx = x[#x] - X[#X], dy = y[#y] - Y[#Y] }
end)
