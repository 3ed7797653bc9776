-- A light bubble rises in a heavier fluid (Hysing et al. 2009, case 1); the right half of it.
-- Expect at t = 3 the centre of mass at y = 1.081, the largest rise velocity 0.2417 at t = 0.92.
case "Rising bubble"

local n = param("n", 40, "cells per unit of length")
local dt = param("dt", 0.02, "time step")
local stop = param("stop", 3, "end")
local e = param("thickness", 0.35, "of the interface, in cells")
local speed = param("speed", 0.1, "at which the interface is restored")

mesh  { box = {{0, 0}, {0.5, 2}}, cells = {n / 2, 2 * n} }
fluid { density = 1000, viscosity = 10, gravity = {0, -0.98} }

term "continuity" {}
term "level_set" { density_2 = 100, viscosity_2 = 1, tension = 24.5, thickness = e / n, speed = speed }

boundary "left"  { symmetry = true }
boundary "right" { symmetry = true }
boundary "*"     { u = {0, 0} }

initial { phi = function(x, y)
  return 1 / (1 + math.exp((math.sqrt(x ^ 2 + (y - 0.5) ^ 2) - 0.25) * n / e))
end }

time   { scheme = "bdf2", step = dt, stop = stop }
output { every = 0.1 }
