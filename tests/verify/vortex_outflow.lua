-- A vortex faster than the stream that carries it leaves through an outflow: below it fluid comes back in.
case "A vortex leaves through an outflow"

local n = param("n", 8, "cells a unit of length")
local spin = param("spin", 4, "largest speed of the vortex, in those of the stream")
local backflow = param("backflow", true, "take the energy of what comes back")
local R = 0.25

mesh  { box = {{0, -1}, {3, 1}}, cells = {3 * n, 2 * n} }
fluid { density = 1, viscosity = 1e-3 }

term "continuity" {}
term "momentum" {}

boundary "left" { u = {1, 0} }
boundary "bottom" { symmetry = true }
boundary "top" { symmetry = true }
boundary "right" (backflow and { backflow = 1 } or { natural = true })

initial {
  u = function(x, y)
    x = x - 2
    local turn = spin / R * math.exp(0.5 - (x * x + y * y) / (2 * R * R))
    return 1 - turn * y, turn * x
  end,
}
exact  { u = {1, 0} } -- the uniform stream that is left
time   { scheme = "bdf2", step = 0.05, stop = 4 }
output { every = 4 }
