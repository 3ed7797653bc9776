-- What the assembly is timed on: unsteady flow in a box with all terms, and bodies in it if asked for.
-- Expect the bodies to begin to fall.
case "Flow in a box"

local dim = param("dim", 2, "2 or 3")
local n = param("n", 32, "cells in each direction; 2D: twice as many upwards")
local shape = param("shape", "quads", "quads, triangles, hexes, tets")
local bodies = param("bodies", 0, "2D: disks at random; 3D: 0 or 1 sphere")
local steps = param("steps", 10, "time steps")
local dt = 0.005

if dim == 2 then
  mesh { box = {{0, 0}, {2, 4}}, cells = {n, 2 * n}, shape = shape }
else
  mesh { box = {{0, 0, 0}, {1, 1, 1}}, cells = {n, n, n}, shape = shape }
end
fluid { density = 1, viscosity = 0.1, gravity = dim == 2 and {0, -981} or {0, 0, -981} }

term "continuity" {}
term "momentum" {}
if bodies > 0 then particulate("sharp") end

boundary "*" { u = dim == 2 and {0, 0} or {0, 0, 0} }

if bodies > 0 and dim == 2 then
  particles { n = bodies, shape = disk { radius = 0.1 }, density = 1.1, inside = {{0.03, 0.5}, {1.97, 3.97}}, gap = 0.02, seed = 3 }
elseif bodies > 0 then
  particle { shape = sphere { radius = 0.15 }, density = 1.1, at = {0.51, 0.49, 0.6} }
end

time   { scheme = "bdf2", step = dt, stop = steps * dt }
output { every = dt }
