-- A closed box with a lid and bodies in it, 2D and 3D, over the range of all numbers that an iterative solver may feel.
case "Lid and bodies"

local dim = param("dim", 3, "2 or 3")
local n = param("n", 6, "cells in each direction")
local shape = param("shape", "", "cells; empty: quads or hexes")
local nu = param("nu", 0.01, "viscosity")
local ratio = param("ratio", 0.1, "nu dt / h^2; 0: steady")
local steps = param("steps", 2, "time steps")
local convection = param("convection", true, "false: a linear problem")
local count = param("count", 0, "free bodies")
local radius = param("radius", 0.15, "of the bodies")
local density = param("density", 2, "of the bodies")
local formulation = param("formulation", "sharp", "sharp or conservative")
local solver = param("solver", "block", "of the linear systems")
local tolerance = param("ltol", 1e-6, "of the linear systems")
local accept = param("tolerance", 1e-6, "of Newton's iteration")

local function all(v) return dim == 2 and {v, v} or {v, v, v} end
local function along(v) return dim == 2 and {v, 0} or {v, 0, 0} end

mesh  { box = {all(0), all(1)}, cells = all(n), shape = shape ~= "" and shape or nil }
fluid { density = 1, viscosity = nu, gravity = count > 0 and (dim == 2 and {0, -1} or {0, -1, 0}) or nil }
term "continuity" {}
term "momentum" { without = not convection and {"convection"} or nil }

boundary "top" { u = along(1) }
boundary "*"   { u = all(0) }

if count > 0 then
  particulate(formulation)
  term "contact.repulsion" { range = 0.02 }
end
if count == 1 then -- off all lines of the mesh
  particle { shape = dim == 2 and disk { radius = radius } or sphere { radius = radius }, density = density,
             at = dim == 2 and {0.513, 0.4891} or {0.513, 0.4891, 0.4928} }
elseif count > 1 then
  particles { n = count, shape = dim == 2 and disk { radius = radius } or sphere { radius = radius }, density = density,
              inside = {all(0.01), all(0.99)}, gap = 0.005, seed = 2 }
end

if ratio > 0 then
  local dt = ratio / n ^ 2 / nu
  time { scheme = "bdf2", step = dt, stop = steps * dt }
  output { every = steps * dt, probes = { a = all(0.71) } }
else
  output { probes = { a = all(0.71) } }
end
solve { solver = solver, linear_tolerance = tolerance, tolerance = accept }

results(function(r)
  local v = { u = r.last["a.u"] }
  if count < 2 then v.p = r.last["a.p"] end -- there may be a body at the place
  if count > 0 then v.fall = r.last["p0.v"] end
  return v
end)
