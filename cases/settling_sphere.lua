-- A sphere settling in a tank of silicone oil (ten Cate et al. 2002), a quarter of it by symmetry, graded towards the walls.
-- Expect the largest speed within 5 % of the experiment's: 0.0360 (E1), 0.0572 (E2), 0.1222 m/s (E4).
case "Sphere settling in a tank"

local which = param("case", "E4", "E1, E2 or E4 of the paper")
local n = param("n", 4, "cells per diameter")
local dt = param("dt", 0.025, "time step, s")
local stop = param("stop", 0.9, "end, s")
local formulation = param("formulation", "sharp", "sharp or conservative")
local d, oil = 0.015, { E1 = {970, 0.373}, E2 = {965, 0.212}, E4 = {960, 0.058} }
local rho, mu = oil[which][1], oil[which][2]

local near = 3 * n // 4 -- equal cells to 3/4 d from the axis, then ever larger ones
local across = graded(0.75 * d, 0.05, math.ceil(1.3 * n), 1.25)
for i = near - 1, 0, -1 do table.insert(across, 1, 0.75 * d * i / near) end

mesh  { box = {{0, 0, 0}, {0.05, 0.05, 0.16}}, cells = {across, across, math.ceil(0.16 * n / d)} }
fluid { density = rho, viscosity = mu, gravity = {0, 0, -9.81} }

term "continuity" {}
term "momentum" {}
particulate(formulation)
term "contact.repulsion" {}

boundary "left"   { symmetry = true }
boundary "bottom" { symmetry = true }
boundary "*"      { u = {0, 0, 0} }

particle { shape = sphere { radius = d / 2 }, density = 1120, at = {0, 0, 0.1275}, hold = {"x", "y", "spin"} }

time   { scheme = "bdf2", step = dt, stop = stop }
output { every = dt * math.ceil(stop / dt / 9 - 1e-9) }

results(function(r)
  local w, most = r.series["p0.w"], 0
  for i = 1, #w do most = math.max(most, math.abs(w[i])) end
  local experiment = ({ E1 = 0.035986, E2 = 0.05718, E4 = 0.12224 })[which]
  return { speed_max = most, ratio = most / experiment, z = r.last["p0.z"] }
end)
