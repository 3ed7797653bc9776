-- Flow round a cylinder in a square channel (DFG 3D-1Z, Schaefer and Turek 1996), steady, Re = 20, on a plain graded box: the cylinder
-- is a fixed body that reaches through both walls. Expect cd 6.185, cl 0.0104, dp 0.1726 (published: 6.05 to 6.25, 0.008 to 0.01, 0.165
-- to 0.175); a minute or two and 2 GB.
case "Flow round a cylinder (DFG 3D), unfitted"

local n = param("n", 6, "cells across the cylinder")
local nz = param("nz", 6, "cells along the cylinder")
local formulation = param("formulation", "sharp", "sharp or conservative")
local height, d, umax = 0.41, 0.1, 0.45
local mean, h = 4 / 9 * umax, d / n

-- equal cells of size h from a to b; outside of that each `ratio` times as long as its neighbour
local function lines(low, a, b, high, ratio)
  local function outward(length)
    return graded(0, length, math.ceil(math.log(1 + length / h * (ratio - 1)) / math.log(ratio)), ratio)
  end
  local list, left, right = {}, outward(a - low), outward(high - b)
  for i = #left, 2, -1 do list[#list + 1] = a - left[i] end
  local m = math.floor((b - a) / h + 0.5)
  for i = 0, m do list[#list + 1] = a + (b - a) * i / m end
  for i = 2, #right do list[#list + 1] = b + right[i] end
  return list
end

mesh  { box = {{0, 0, 0}, {2.5, height, height}},
        cells = { lines(0, 0.412, 0.612, 2.5, 1.4), lines(0, 0.122, 0.272, height, 1.3), clustered(0, height, nz, 0.8) } }
fluid { density = 1, viscosity = 1e-3 }

term "continuity" {}
term "momentum" {}
particulate(formulation)

boundary "left"  { u = function(x, y, z) return 16 * umax * y * z * (height - y) * (height - z) / height ^ 4, 0, 0 end }
boundary "right" { natural = true }
boundary "*"     { u = {0, 0, 0} }

particle { shape = cylinder { radius = d / 2, length = 1 }, density = 1, at = {0.5, 0.2, height / 2}, motion = "fixed" }

output { probes = { front = {0.45, 0.2, 0.205}, rear = {0.55, 0.2, 0.205} } }

results(function(r)
  local c = 2 / (mean ^ 2 * d * height)
  return { cd = c * r.last["p0.fx"], cl = c * r.last["p0.fy"], dp = r.last["front.p"] - r.last["rear.p"] }
end)
