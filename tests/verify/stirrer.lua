-- A disk that is moved to and fro, or held, in a periodic flow that a force turns: all of the fluid is near the disk.
case "Stirrer"

local tolerance = param("tolerance", 1e-2, "of steps")
local dt = param("dt", 0, "length of all steps instead")
local motion = param("motion", "prescribed", "prescribed or fixed")

mesh  { box = {{0, 0}, {2 * math.pi, 2 * math.pi}}, cells = {12, 12} }
fluid { density = 1, viscosity = 0.1 }
term "continuity" {}
term "momentum" { force = function(x, y, t) return -2 * math.sin(2 * t), 2 * math.cos(2 * t) end }
particulate "sharp"
boundary { periodic = {"left", "right"} }
boundary { periodic = {"bottom", "top"} }
particle { shape = disk { radius = 1.2 }, density = 1, at = {3.1, 3.1}, motion = motion,
           velocity = motion == "prescribed" and {function(t) return 0.15 * math.sin(t) end, 0} or nil }
initial { u = function(x, y) return 1 + math.sin(x) * math.cos(y), -math.cos(x) * math.sin(y) end }
if dt > 0 then time { step = dt, stop = 3 } else time { tolerance = tolerance, stop = 3 } end
output  { every = 3, probes = { a = {1, 1} } }
results(function(r) return { v = r.last["a.v"] } end)
