-- Polymers in a channel (Oldroyd-B): with total viscosity mu + mu_p the velocity is that of Poiseuille flow, and
-- tau_xx = 2 lambda mu_p (du/dy)^2, tau_xy = mu_p du/dy.  The logarithm of the conformation is no polynomial:
-- expect errors of third order in the size of the cells.  Weissenberg number lambda du/dy at the wall: 4 lambda.
case "Oldroyd-B fluid in a channel"

local n = param("n", 8, "cells across")
local shape = param("shape", "quads", "quads or triangles")
local mu, mu_p = param("mu", 0.6, "viscosity of the solvent"), param("mu_p", 0.4, "viscosity by the polymers")
local lambda = param("lambda", 0.25, "relaxation time")

mesh  { box = {{0, 0}, {3, 1}}, cells = {2 * n, n}, shape = shape }
fluid { density = 1, viscosity = mu, polymer_viscosity = mu_p, relaxation_time = lambda }

term "continuity" {}
term "momentum" { without = {"convection", "inertia"} }
term "oldroyd_b" {}

local function profile(x, y) return 4 * y * (1 - y), 0 end
local function rate(y) return 4 - 8 * y end

-- logarithm of the symmetric matrix (a b; b c)
local function log(a, b, c)
  local m, d = (a + c) / 2, (a - c) / 2
  local r = math.sqrt(d * d + b * b)
  local half, mean = 0.5 * math.log((m + r) / (m - r)), 0.5 * math.log(m * m - r * r)
  local f = r > 1e-8 and half / r or 1 / m
  return mean + f * d, f * b, mean - f * d
end
local function psi(x, y)
  local w = lambda * rate(y)
  return log(1 + 2 * w * w, w, 1)
end

boundary "left"   { u = profile, psi = psi }
boundary "right"  { traction = function(x, y) return 2 * lambda * mu_p * rate(y) ^ 2, (mu + mu_p) * rate(y) end }
boundary "bottom" { u = {0, 0} }
boundary "top"    { u = {0, 0} }

exact  { u = profile, p = function(x, y) return 8 * (mu + mu_p) * (3 - x) end, psi = psi }
output { forces = {"bottom", "top"}, lines = { outlet = { from = {3, 0}, to = {3, 1}, points = 41 } } }
