-- A profile of temperature that a uniform flow carries through a square, hardly conducted.
-- Expect an error of T in L2 of 1.3e-3 without the streamline term and 2.7e-4 with it.
case "Profile carried by a flow"

local n = param("n", 16, "cells in each direction")
local shape = param("shape", "quads", "quads or triangles")
local layer = param("layer", false, "a jump in place of a wave")
local streamline = param("streamline", true, "with the streamline term")
local k = param("conductivity", 1e-8, "of the fluid")

local function T(x, y)
  local across = y - x / 2
  if layer then return across > 0.1 and 1 or 0 end
  return math.sin(6 * across)
end

mesh  { box = {{0, 0}, {1, 1}}, cells = {n, n}, shape = shape }
fluid { density = 1, viscosity = 1 }

term "continuity" {}
term "momentum" {}
term "scalar_transport" { conductivity = k, heat_capacity = 1 }
if streamline then term "scalar_transport.streamline" { conductivity = k, heat_capacity = 1 } end

boundary "left"   { u = {1, 0.5}, T = T }
boundary "bottom" { u = {1, 0.5}, T = T }
boundary "*"      { u = {1, 0.5} }

exact  { u = {1, 0.5}, T = T }
output { lines = { across = { from = {0.9, 0}, to = {0.9, 1}, points = 401 } } }
