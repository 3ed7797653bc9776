-- Two disks fall one above the other: the upper one is drawn into the wake (drafting), catches up (kissing), and the
-- pair turns over (tumbling). Expect no overlap beyond 1 % of the diameter.
case "Drafting, kissing, tumbling"

local n = param("n", 16, "cells per cm")
local dt = param("dt", 0.005, "time step, s")
local stop = param("stop", 1.0, "end, s")
local formulation = param("formulation", "sharp", "sharp or conservative")
local d = 0.25

mesh  { box = {{0, 0}, {2, 6}}, cells = {2 * n, 6 * n} }
fluid { density = 1, viscosity = 0.1, gravity = {0, -981} }

term "continuity" {}
term "momentum" {}
particulate(formulation)
term "contact.repulsion" { range = 0.06 }

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = d / 2 }, density = 1.25, at = {1.001, 5} }
particle { shape = disk { radius = d / 2 }, density = 1.25, at = {0.999, 4.5} }

time   { step = dt, stop = stop }
output { every = dt * math.ceil(stop / dt / 20 - 1e-9) }

results(function(r)
  local x, y, X, Y = r.series["p0.x"], r.series["p0.y"], r.series["p1.x"], r.series["p1.y"]
  local gap, kiss = 1e9, 0
  for i = 1, #x do
    local g = math.sqrt((x[i] - X[i]) ^ 2 + (y[i] - Y[i]) ^ 2) - d
    if g < gap then gap, kiss = g, r.t[i] end
  end
  return { smallest_gap = gap / d, at = kiss, dx = x[#x] - X[#X], dy = y[#y] - Y[#Y] }
end)
