-- Fluids whose viscosity depends on the shear rate between two plates, half of the channel, symmetric about y = 0.
-- The stress is G y whatever the law, which gives the rate at each place and, integrated, the velocity.  Expect that
-- profile with errors of third order; of a Bingham fluid a plug up to y = tau_y/G, as far as the regularisation
-- lets it: what is solid creeps with rates of about G y/(m tau_y).
case "Channel flow by a law of the shear rate"

local n = param("n", 8, "cells across half of the channel")
local law = param("law", "carreau", "carreau, cross or bingham")
local m = param("m", 300, "regularisation of bingham, s")
local G, H = 4, 0.5
local exponent, mu0, mu1, t = 0.4, 1, 0.02, 2      -- carreau, cross
local mu, yield = 0.1, 0.8                         -- bingham: solid up to y = 0.2

mesh  { box = {{0, 0}, {1, H}}, cells = {2, n} }
fluid { density = 1 }

term "continuity" {}
term "momentum" { without = {"convection", "inertia"}, force = {G, 0} }
term "generalised_newtonian" { law = law, exponent = exponent, zero_shear_viscosity = mu0,
  infinite_shear_viscosity = mu1, time_constant = t, plastic_viscosity = mu, yield_stress = yield, regularisation = m }

boundary { periodic = {"left", "right"} }
boundary "bottom" { symmetry = true }
boundary "top"    { u = {0, 0} }

-- shear rate at a stress, by bisection
local function viscosity(rate)
  if law == "carreau" then return mu1 + (mu0 - mu1) * (1 + (t * rate) ^ 2) ^ ((exponent - 1) / 2) end
  return mu1 + (mu0 - mu1) / (1 + (t * rate) ^ (1 - exponent))
end
local function rate_at(stress)
  if law == "bingham" then return math.max(stress - yield, 0) / mu end
  local low, high = 0, stress / mu1
  for k = 1, 60 do
    local rate = (low + high) / 2
    if viscosity(rate) * rate < stress then low = rate else high = rate end
  end
  return (low + high) / 2
end

local known = {}
-- velocity at y: the rate from there to the wall, Gauss's rule of 3 points on 16 parts
local function profile(x, y)
  if law == "bingham" then
    local solid = yield / G
    local function out(y) return G / (2 * mu) * ((H - solid) ^ 2 - math.max(y - solid, 0) ^ 2) end
    return out(math.abs(y)), 0
  end
  if known[y] then return known[y], 0 end
  local u, d = 0, (H - math.abs(y)) / 16
  for k = 0, 15 do
    local a = math.abs(y) + (k + 0.5) * d
    u = u + d / 18 * (5 * rate_at(G * (a - 0.5 * d * math.sqrt(0.6))) + 8 * rate_at(G * a)
                      + 5 * rate_at(G * (a + 0.5 * d * math.sqrt(0.6))))
  end
  known[y] = u
  return u, 0
end

if law == "bingham" then
  solve { continuation = { regularisation = 0.1 } }
end
exact { u = profile }
output { probes = { middle = {0.5, 0}, edge = {0.5, 0.9 * yield / G} } }
results(function(r)
  if law ~= "bingham" then return {} end
  local middle, edge = r.last["middle.u"], r.last["edge.u"]
  return { plug = middle, plug_exact = (profile(0, 0)), across = 1 - edge / middle }
end)
