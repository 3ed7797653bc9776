-- Slow flow of an Oldroyd-B fluid round a cylinder that blocks half of a channel; upper half, radius 1, mean velocity
-- 1, total viscosity 1, of which 0.59 is the solvent's.  Wi = lambda U / R.  Expect the drag coefficient
-- F / ((mu + mu_p) U), Hulsen, Fattal and Kupferman 2005: Wi = 0.1 130.36, 0.5 118.83, 0.6 117.78, 0.7 117.32.
case "Oldroyd-B fluid round a confined cylinder"

local wi = param("wi", 0.5, "Weissenberg number")
local file = param("mesh", "mesh/confined_cylinder.geo", "mesh of the upper half")
local mu, mu_p = 0.59, 0.41

mesh  { file = file }
fluid { density = 1, viscosity = mu, polymer_viscosity = mu_p, relaxation_time = wi }

term "continuity" {}
term "momentum" { without = {"convection", "inertia"} }
term "oldroyd_b" {}

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

boundary "inlet" { u = profile, psi = function(x, y)
  local w = wi * rate(y)
  return log(1 + 2 * w * w, w, 1)
end }
boundary "outlet" { traction = function(x, y) return 2 * wi * mu_p * rate(y) ^ 2, (mu + mu_p) * rate(y) end }
boundary "walls" { u = {0, 0} }
boundary "cylinder" { u = {0, 0} }
boundary "axis" { symmetry = true }

solve { continuation = { relaxation_time = 0.1 * wi } }
output { forces = {"cylinder"}, lines = { wake = { from = {1, 0}, to = {6, 0}, points = 201 } } }

results(function(r) return { K = 2 * r.last["cylinder.fx"] / (mu + mu_p) } end)
