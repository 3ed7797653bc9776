-- Power-law fluid between two plates; the viscosity is K g^(n-1), g the shear rate.  Half of the channel, symmetric
-- about y = 0; the pressure falls by G a length.  Expect u = n/(n+1) (G/K)^(1/n) (H^(1+1/n) - y^(1+1/n)), H = 1/2,
-- with errors of third order in the size of the cells.  These get smaller towards the middle, where for n > 1 the
-- second derivative of the velocity is infinite.
case "Power-law fluid in a channel"

local n = param("n", 8, "cells across half of the channel")
local exponent = param("exponent", 0.5, "n of the power law")
local shape = param("shape", "quads", "quads or triangles")
local K, G, H = 2, 4, 0.5

local across = {}
for k = 0, n do across[k + 1] = H * (k / n) ^ 2 end

mesh  { box = {{0, 0}, {1, H}}, cells = {n, across}, shape = shape }
fluid { density = 1 }

term "continuity" {}
term "momentum" { without = {"convection", "inertia"} }
term "generalised_newtonian" { law = "power_law", consistency = K, exponent = exponent }

local m = 1 + 1 / exponent
local function profile(x, y) return (G / K) ^ (1 / exponent) * (H ^ m - math.abs(y) ^ m) / m, 0 end

boundary "left"   { u = profile }
boundary "right"  { traction = function(x, y) return 0, -G * y end }
boundary "bottom" { symmetry = true }
boundary "top"    { u = {0, 0} }

solve  { continuation = { exponent = 1 } }
exact  { u = profile, p = function(x, y) return G * (1 - x) end }
output { forces = {"top"} }
