-- Natural convection in a square cavity, hot on the left and cold on the right (de Vahl Davis 1983).
-- Expect one clockwise cell and nu = 1.118, 2.243, 4.519, 8.800 at ra = 1e3, 1e4, 1e5, 1e6 (grids of 1983).
case "Differentially heated cavity"

local ra = param("ra", 1e4, "Rayleigh number")
local pr = param("pr", 0.71, "Prandtl number")
local n = param("n", 32, "cells in each direction")

-- Lengths in widths of the cavity, times in width^2 / diffusivity, T from 0 to 1: then k = c = rho = 1, mu = Pr,
-- and the force of buoyancy is Ra Pr (T - 1/2) upwards.
mesh  { box = {{0, 0}, {1, 1}}, cells = {n, n} }
fluid { density = 1, viscosity = pr, gravity = {0, -1} }

term "continuity" {}
term "momentum" {}
term "scalar_transport" { conductivity = 1, heat_capacity = 1, expansion = ra * pr, reference_temperature = 0.5 }

boundary "left"  { u = {0, 0}, T = 1 }
boundary "right" { u = {0, 0}, T = 0 }
boundary "*"     { u = {0, 0} }             -- top and bottom: no line for T, so no heat passes

output { forces = {"left", "right"},
         lines = { middle = { from = {0, 0.5}, to = {1, 0.5}, points = 129 } } }

-- left.heat is what the fluid gives to the wall; the reverse, over k (T_hot - T_cold) = 1, is the mean Nusselt number.
results(function(r)
  return { nu = -r.last["left.heat"] }
end)
