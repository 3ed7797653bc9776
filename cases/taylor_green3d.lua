-- Taylor-Green vortex in three dimensions, Re = 1600: smooth at first, then vortices break up into ever smaller ones. Its
-- symmetries are kept: instead of the periodic box 2 pi wide an eighth of it, with symmetry planes (Brachet et al. 1983,
-- J. Fluid Mech. 130:411). Expect, in the whole flow (Dairay et al. 2017, J. Comput. Phys. 337:252), energy and dissipation
-- 0.12151, 0.002066 at t = 4, 0.11358, 0.005531 at t = 6; largest dissipation 0.01285 at t = 8.98. The default mesh is good up to
-- t = 4 (in three minutes); smaller vortices need n = 32 and more.
case "Taylor-Green vortex (3D)"

local re = param("re", 1600, "Reynolds number")
local n = param("n", 6, "cells in each direction, in an eighth of the box")
local dt = param("dt", 0.1, "time step")
local stop = param("stop", 4, "end")

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
time { scheme = "bdf2", step = dt, stop = stop }

-- The flow is its own image in turns of a quarter about x = y = pi/2 and of a half about x = z = pi/2: 64 places in an eighth
-- of this box are as good as 16 in each direction of the whole one, whose mean is the energy as long as the flow is smooth.
local m, at = 4, {}
for i = 0, m ^ 3 - 1 do
  local function place(k) return (k + 0.5) * math.pi / (2 * m) end
  at["e" .. i] = {place(i % m), place(i // m % m), place(i // (m * m))}
end

-- Against a flow at rest errors are norms of the flow itself.
exact  { u = {0, 0, 0} }
output { every = stop, probes = at }

results(function(r)
  local volume, energy = math.pi ^ 3, {}
  for k = 1, #r.t do
    local sum = 0
    for i = 0, m ^ 3 - 1 do
      local name = "e" .. i
      sum = sum + r.series[name .. ".u"][k] ^ 2 + r.series[name .. ".v"][k] ^ 2 + r.series[name .. ".w"][k] ^ 2
    end
    energy[k] = 0.5 * sum / m ^ 3
  end
  local most, when = 0, 0 -- largest loss of energy, by central differences
  for k = 2, #r.t - 1 do
    local loss = (energy[k - 1] - energy[k + 1]) / (r.t[k + 1] - r.t[k - 1])
    if loss > most then most, when = loss, r.t[k] end
  end
  return { energy = 0.5 * r.errors.u.l2 ^ 2 / volume, dissipation = r.errors.u.h1 ^ 2 / (re * volume),
           energy_of_places = energy[#energy], largest_loss = most, at = when }
end)
