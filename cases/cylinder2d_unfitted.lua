-- Flow round a cylinder in a channel (DFG benchmark, Schaefer and Turek 1996) on a plain graded box: the cylinder is a fixed
-- body that cuts through cells. Expect what cylinder2d gives: cd 5.5795, cl 0.01062, dp 0.1175; with --set unsteady=true (20 minutes) St 0.301, cd_max 3.23.
case "Flow round a cylinder (DFG 2D), unfitted"

local unsteady = param("unsteady", false, "2D-2 instead of 2D-1")
local dt = param("dt", 0.005, "time step of 2D-2")
local stop = param("stop", 8, "end of 2D-2")
local n = param("n", 20, "cells across the cylinder")
local formulation = param("formulation", "sharp", "sharp or conservative")

local umax, height, d = unsteady and 1.5 or 0.3, 0.41, 0.1
local mean = 2 / 3 * umax
local h = d / n

-- equal cells of size h from a to b; outside of that each `ratio` times as long as its neighbour
local function lines(low, a, b, high, ratio)
  local function outward(length)
    local k = math.ceil(math.log(1 + length / h * (ratio - 1)) / math.log(ratio))
    return graded(0, length, k, ratio)
  end
  local list, left, right = {}, outward(a - low), outward(high - b)
  for i = #left, 2, -1 do list[#list + 1] = a - left[i] end
  local m = math.floor((b - a) / h + 0.5)
  for i = 0, m do list[#list + 1] = a + (b - a) * i / m end
  for i = 2, #right do list[#list + 1] = b + right[i] end
  return list
end

mesh  { box = {{0, 0}, {2.2, height}},
        cells = unsteady and { lines(0, 0.122, 0.402, 2.2, 1.04), lines(0, 0.098, 0.303, height, 1.15) }
                or { lines(0, 0.127, 0.317, 2.2, 1.1), lines(0, 0.123, 0.278, height, 1.15) } }
fluid { density = 1, viscosity = 1e-3 }

term "continuity" {}
term "momentum" {}
particulate(formulation)

boundary "left"  { u = function(x, y) return 4 * umax * y * (height - y) / height ^ 2, 0 end }
boundary "right" { natural = true }
boundary "*"     { u = {0, 0} }

particle { shape = disk { radius = d / 2 }, density = 1, at = {0.2, 0.2}, motion = "fixed" }

if unsteady then
  time { scheme = "bdf2", step = dt, stop = stop }
end

output { every = dt * math.ceil(stop / dt / 20 - 1e-9), probes = { front = {0.15, 0.2}, rear = {0.25, 0.2} } }

results(function(r)
  local c = 2 / (mean ^ 2 * d)
  if not unsteady then
    return { cd = c * r.last["p0.fx"], cl = c * r.last["p0.fy"], dp = r.last["front.p"] - r.last["rear.p"] }
  end
  -- largest values and period over the last quarter of the run
  local t, fx, fy = r.t, r.series["p0.fx"], r.series["p0.fy"]
  local cd, high, low, first, last, crossings = 0, -1e9, 1e9, nil, nil, 0
  for i = 2, #t do
    if t[i] > 0.75 * stop then
      cd, high, low = math.max(cd, c * fx[i]), math.max(high, c * fy[i]), math.min(low, c * fy[i])
      if fy[i - 1] < 0 and fy[i] >= 0 then
        last = t[i - 1] + (t[i] - t[i - 1]) * fy[i - 1] / (fy[i - 1] - fy[i])
        first = first or last
        crossings = crossings + 1
      end
    end
  end
  local st = crossings > 1 and d / mean * (crossings - 1) / (last - first) or 0
  return { cd_max = cd, cl_max = high, cl_min = low, cl_amplitude = (high - low) / 2, strouhal = st }
end)
