-- Taylor-Green vortex in three dimensions, Re = 1600: smooth at first, then it breaks up into ever smaller vortices. Instead of
-- the periodic box, 2 pi wide, an eighth of it with symmetry planes: the flow keeps its symmetries (Brachet et al. 1983, J. Fluid
-- Mech. 130:411). Energy and dissipation at the end are means over the box; with other values of `stop` they are curves.
-- Expect (Dairay et al. 2017, J. Comput. Phys. 337:252) at t = 2.5, 4, 6: energy 0.12352, 0.12151, 0.11358 and dissipation 0.000881,
-- 0.002066, 0.005531, which is largest at 8.98: 0.01285. The default is coarse: 0.1231 and 0.00110 at 2.5, half a minute. With
-- --set n=16 --set tolerance=1e-2 --set stabilise=true --set stop=10 it runs through, in a quarter of an hour, and -dE/dt is
-- largest at 9.0: 0.0133 (docs/pictures).
case "Taylor-Green vortex (3D)"

local re = param("re", 1600, "Reynolds number")
local n = param("n", 8, "cells in each direction, in an eighth of the box")
local dt = param("dt", 0.1, "time step")
local stop = param("stop", 2.5, "end")

mesh  { box = {{0, 0, 0}, {math.pi, math.pi, math.pi}}, cells = {n, n, n} }
fluid { density = 1, viscosity = 1 / re }

term "continuity" {}
term "momentum" {}

boundary "*" { symmetry = true }

initial {
  u = function(x, y, z)
    return math.sin(x) * math.cos(y) * math.cos(z), -math.cos(x) * math.sin(y) * math.cos(z), 0
  end,
  p = function(x, y, z) return (math.cos(2 * x) + math.cos(2 * y)) * (math.cos(2 * z) + 2) / 16 end
}
local tolerance = param("tolerance", 0, "of steps that choose their length; 0: all are dt")
if tolerance > 0 then time { tolerance = tolerance, stop = stop } else time { scheme = "bdf2", step = dt, stop = stop } end
if param("stabilise", false, "terms against convection that the mesh does not resolve") then term "stabilise" {} end

-- Against a flow at rest the errors are norms of the flow itself.
exact  { u = {0, 0, 0} }
output { every = stop }

results(function(r)
  local volume = math.pi ^ 3
  return { energy = 0.5 * r.errors.u.l2 ^ 2 / volume, dissipation = r.errors.u.h1 ^ 2 / (re * volume) }
end)
