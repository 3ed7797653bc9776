-- A disk that dissolves: its surface releases a species at a given rate per area, and fluid at rest carries it away by
-- diffusion.  Expect c = (q a/D) log(b/r), which the outer boundary has as its value: errors of second order or
-- better in the size of the cells, and 2 pi a q through the boundary, to the accuracy of the circumference (1e-8).
-- With --set stream=1 the fluid moves past the disk with this velocity, and there is no exact solution.
case "Dissolving disk"

local n = param("n", 20, "cells across the box")
local D, q, a, b = param("D", 0.5, "diffusivity"), param("q", 2, "release"), 0.31, 2
local stream = param("stream", 0, "velocity far away")
local at = {0.013, 0.021}

mesh  { box = {{-1, -1}, {1, 1}}, cells = {n, n}, shape = param("shape", "quads", "quads or triangles") }
fluid { density = 1, viscosity = 0.1, diffusivity = D }

term "continuity" {}
term "momentum" {}
term "species" {}
term "species.body" { release = q }
particulate "sharp"

local function c(x, y) return q * a / D * math.log(b / math.sqrt((x - at[1]) ^ 2 + (y - at[2]) ^ 2)) end

boundary "left" { u = {stream, 0}, c = stream == 0 and c or 0 }
if stream == 0 then
  boundary "*" { u = {0, 0}, c = c }
  exact { c = c }
else
  boundary "right" { natural = true }
  boundary "*" { u = {stream, 0} }
end
particle { shape = disk { radius = a }, density = 1, at = at, motion = "fixed" }

output { forces = {"left", "right", "bottom", "top"} }
results(function(r)
  local sum = 0
  for _, side in ipairs {"left", "right", "bottom", "top"} do sum = sum + r.last[side .. ".flow"] end
  return { released = sum / (2 * math.pi * a * q) }
end)
