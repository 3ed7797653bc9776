-- Natural convection in a square cavity, hot on the left and cold on the right (de Vahl Davis 1983).
-- Expect nu = 1.118, 2.2448, 4.5216, 8.8252 at ra = 1e3, 1e4, 1e5, 1e6.
case "Natural convection in a cavity"

local ra = param("ra", 1e4, "Rayleigh number")
local pr = param("pr", 0.71, "Prandtl number")
local n = param("n", 32, "cells in each direction")

-- Lengths in widths of the cavity, times in width^2 / diffusivity, T from -1/2 to 1/2: then k = c = rho = 1, mu = Pr,
-- and the force of buoyancy is Ra Pr T upwards.
local lines = clustered(0, 1, n, 1.5)

mesh  { box = {{0, 0}, {1, 1}}, cells = {lines, lines} }
fluid { density = 1, viscosity = pr, gravity = {0, -1}, conductivity = 1, heat_capacity = 1 }

term "continuity" {}
term "momentum" {}
term "heat" { expansion = ra * pr }

boundary "left"  { u = {0, 0}, T = 0.5 }
boundary "right" { u = {0, 0}, T = -0.5 }
boundary "*"     { u = {0, 0} }             -- top and bottom: no line for T, so no heat passes

output { forces = {"left", "right"}, lines = { middle = { from = {0, 0.5}, to = {1, 0.5}, points = 129 } } }

-- left.heat is what the fluid gives to the wall; the reverse, over k (T_hot - T_cold) = 1, is the mean Nusselt number.
results(function(r)
  return { nu = -r.last["left.heat"], defect = r.last["left.heat"] + r.last["right.heat"] }
end)
