-- Kovasznay flow: the wake behind a row of obstacles, an exact solution of Navier-Stokes.
-- Expect errors that fall with h^3 (velocity) and h^2 (pressure).
case "Kovasznay flow"

local n = param("n", 16, "cells in each direction")
local re = param("re", 40, "Reynolds number")
local shape = param("shape", "quads", "quads or triangles")

local l = re / 2 - math.sqrt(re * re / 4 + 4 * math.pi ^ 2)
local function velocity(x, y)
  return 1 - math.exp(l * x) * math.cos(2 * math.pi * y), l / (2 * math.pi) * math.exp(l * x) * math.sin(2 * math.pi * y)
end

mesh  { box = {{-0.5, -0.5}, {1, 1.5}}, cells = {n, n}, shape = shape }
fluid { density = 1, viscosity = 1 / re }

term "continuity" {}
term "momentum" {}

boundary "*" { u = velocity }

exact { u = velocity, p = function(x, y) return 0.5 * (1 - math.exp(2 * l * x)) end }
