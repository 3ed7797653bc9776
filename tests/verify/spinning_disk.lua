-- A disk that is spun up in fluid at rest, and, free along x, held in a flow that starts: the active set does not
-- change, so all error in time is of the scheme.
case "Spun up disk"

local dt = param("dt", 0.05, "time step")
local free_spin = param("free", false, "spin free, driven by walls that start to move")

mesh  { box = {{-0.5, -0.5}, {0.5, 0.5}}, cells = {12, 12} }
fluid { density = 1, viscosity = 0.05 }

term "continuity" {}
term "momentum" {}
-- the terms of particulate "conservative", with a pressure smoothing that does not depend on the step
term "multiplier" {}
term "rigid_body" {}
term "continuity.pressure_smoothing" { density = 0 }

if free_spin then
  boundary "*" { u = function(x, y, t) local s = 1 - math.cos(3 * t); return -y * s, x * s end }
  particle { shape = ellipse { a = 0.2, b = 0.2 }, density = 3, at = {0.013, 0.0091}, hold = {"x", "y"} }
else
  boundary "*" { u = {0, 0} }
  particle { shape = disk { radius = 0.2 }, density = 1, at = {0.013, 0.0091}, motion = "prescribed",
             spin = function(t) return 1 - math.cos(3 * t) end }
end

time   { step = dt, stop = 1 }
output { every = 1, probes = { near = {0.3, 0.1} } }

results(function(r)
  return { v = r.last["near.v"], torque = r.last["p0.torque"], omega = r.last["p0.omega"], angle = r.last["p0.angle"] }
end)
