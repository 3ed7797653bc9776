-- A neutrally buoyant body in fluid at rest, under any gravity: nothing may move.
-- Expect velocities at round-off: with the reduced pressure the body does not notice gravity.
case "Neutrally buoyant body at rest"

local gx, gy = param("gx", 3, "gravity"), param("gy", -981, "gravity")
local steps = param("steps", 100, "time steps")
local formulation = param("formulation", "sharp", "sharp or conservative")

mesh  { box = {{0, 0}, {1, 1}}, cells = {16, 16} }
fluid { density = 1, viscosity = 0.01, gravity = {gx, gy} }

term "continuity" {}
term "momentum" {}
particulate(formulation)

boundary "*" { u = {0, 0} }

particle { shape = ellipse { a = 0.2, b = 0.12 }, density = 1, at = {0.47, 0.53}, angle = 0.3 }

time { step = 1e-2, stop = 1e-2 * steps }

results(function(r)
  local most = 0
  for _, name in ipairs { "p0.u", "p0.v", "p0.omega" } do
    for _, v in ipairs(r.series[name]) do most = math.max(most, math.abs(v)) end
  end
  return { largest = most, relative = most / (math.sqrt(gx * gx + gy * gy) * 1e-2) }
end)
