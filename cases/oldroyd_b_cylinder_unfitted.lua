-- Slow flow of an Oldroyd-B fluid round a cylinder that blocks half of a channel, as oldroyd_b_cylinder, on a graded
-- box: the cylinder is a fixed body that cuts through cells, and feels the polymers on its surface.  Both halves.
-- Expect the drag coefficient of oldroyd_b_cylinder: Wi = 0.1 130.36 (n = 8 / 16: 130.306 / 130.359), 0.2 126.627.
-- At larger Wi there is no steady solution on meshes as coarse as these: beside the surface fluid rests, and polymers
-- grow for ever where grad u has an eigenvalue above 1/(2 lambda), which errors of a large shear rate are enough for.
case "Oldroyd-B fluid round a confined cylinder, unfitted"

local wi = param("wi", 0.1, "Weissenberg number")
local n = param("n", 16, "cells across the cylinder")
local mu, mu_p, h = 0.59, 0.41, 2 / n

-- equal cells of size h from -1.2 to 1.2, then each 1.1 times as long as its neighbour, out to `far` either side
local function lines(left, right)
  local function outward(length)
    return graded(0, length, math.ceil(math.log(1 + length / h * 0.1) / math.log(1.1)), 1.1)
  end
  local list, l, r, m = {}, outward(left - 1.2), outward(right - 1.2), math.ceil(2.4 / h)
  for i = #l, 2, -1 do list[#list + 1] = -1.2 - l[i] end
  for i = 0, m do list[#list + 1] = -1.2 + 2.4 * i / m end
  for i = 2, #r do list[#list + 1] = 1.2 + r[i] end
  return list
end

mesh  { box = {{-8, -2}, {12, 2}}, cells = { lines(8, 12), 2 * n } }
fluid { density = 1, viscosity = mu, polymer_viscosity = mu_p, relaxation_time = wi }

term "continuity" {}
term "momentum" { without = {"convection", "inertia"} }
term "oldroyd_b" {}
particulate "sharp"

local function profile(x, y) return 1.5 * (1 - y * y / 4), 0 end
local function rate(y) return -0.75 * y end

-- logarithm of the symmetric matrix (a b; b c)
local function log(a, b, c)
  local m, d = (a + c) / 2, (a - c) / 2
  local r = math.sqrt(d * d + b * b)
  local half, mean = 0.5 * math.log((m + r) / (m - r)), 0.5 * math.log(m * m - r * r)
  local f = r > 1e-8 and half / r or 1 / m
  return mean + f * d, f * b, mean - f * d
end

boundary "left" { u = profile, psi = function(x, y)
  local w = wi * rate(y)
  return log(1 + 2 * w * w, w, 1)
end }
boundary "right" { traction = function(x, y) return 2 * wi * mu_p * rate(y) ^ 2, (mu + mu_p) * rate(y) end }
boundary "*" { u = {0, 0} }
particle { shape = disk { radius = 1 }, density = 1, at = {0, 0}, motion = "fixed" }

solve { continuation = { relaxation_time = 0.1 * wi } }
results(function(r) return { K = r.last["p0.fx"] / (mu + mu_p) } end)
