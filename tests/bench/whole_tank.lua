-- The settling sphere E4 of cases/settling_sphere.lua in the whole tank: the same mesh, mirrored, and a sphere that is free.
-- Expect the same speed as in the quarter.
case "Sphere settling in the whole tank"

local n = param("n", 4, "cells per diameter")
local steps = param("steps", 36, "time steps")
local d, dt = 0.015, 0.025

local near = 3 * n // 4
local half = graded(0.75 * d, 0.05, math.ceil(1.3 * n), 1.25)
for i = near - 1, 1, -1 do table.insert(half, 1, 0.75 * d * i / near) end
local across = {}
for i = #half, 1, -1 do across[#across + 1] = -half[i] end
across[#across + 1] = 0
for i = 1, #half do across[#across + 1] = half[i] end

mesh  { box = {{-0.05, -0.05, 0}, {0.05, 0.05, 0.16}}, cells = {across, across, math.ceil(0.16 * n / d)} }
fluid { density = 960, viscosity = 0.058, gravity = {0, 0, -9.81} }

term "continuity" {}
term "momentum" {}
particulate("sharp")
term "contact.repulsion" {}

boundary "*" { u = {0, 0, 0} }

particle { shape = sphere { radius = d / 2 }, density = 1120, at = {0, 0, 0.1275} }

time   { scheme = "bdf2", step = dt, stop = steps * dt }
output { every = dt * math.ceil(steps / 9) }

results(function(r)
  local w, most = r.series["p0.w"], 0
  for i = 1, #w do most = math.max(most, math.abs(w[i])) end
  return { speed_max = most, ratio = most / 0.12224 }
end)
