-- Simple shear at rate g from rest, or from shear that stops (rate 0 from the state that shear leaves): homogeneous.
-- c_xy = lambda g (1 - e), c_xx = 1 + 2 (lambda g)^2 (1 - e (1 + t/lambda)), c_yy = 1, e = exp(-t/lambda).
local dt, lambda, g = param("dt", 0.1, ""), 0.5, 3
local stops = param("stops", false, "shear stops instead of starting")
local shape = param("shape", "quads", "")

mesh  { box = {{0, 0}, {1, 1}}, cells = {2, 2}, shape = shape }
fluid { density = 1, viscosity = 1, polymer_viscosity = 2, relaxation_time = lambda }
term "continuity" {}
term "momentum" { without = {"convection", "inertia"} }
term "oldroyd_b" {}

-- logarithm of the symmetric matrix (a b; b c)
local function log(a, b, c)
  local m, d = (a + c) / 2, (a - c) / 2
  local r = math.sqrt(d * d + b * b)
  local half, mean = 0.5 * math.log((m + r) / (m - r)), 0.5 * math.log(m * m - r * r)
  local f = r > 1e-8 and half / r or 1 / m
  return mean + f * d, f * b, mean - f * d
end
local function psi(x, y, t)
  local w, e = lambda * g, math.exp(-t / lambda)
  if stops then return log(1 + 2 * w * w * e, w * e, 1) end
  return log(1 + 2 * w * w * (1 - e * (1 + t / lambda)), w * (1 - e), 1)
end
local function u(x, y) return stops and 0 or g * y, 0 end

boundary "*" { u = u }
boundary { periodic = {"left", "right"} }
initial { u = u, psi = psi }
exact { u = u, psi = psi }
solve { tolerance = 1e-12 }
time { step = dt, stop = 1 }
