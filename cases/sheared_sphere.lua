-- A neutrally buoyant sphere near the middle of a cube that is sheared, Stokes flow: it turns with half the shear rate.
-- Expect omega / shear rate = -0.5 within 3 % at D/h = 5 (n = 10).
case "Sphere in shear"

local n = param("n", 10, "cells in each direction; D/h = n / 2")
local x0, y0, z0 = param("x0", 0.013, "centre"), param("y0", 0.0091, "centre"), param("z0", -0.0072, "centre")
local hold = param("hold", "nothing", "nothing, or place: the sphere may only turn")
local formulation = param("formulation", "sharp", "sharp or conservative")

mesh  { box = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, cells = {n, n, n} }
fluid { density = 1, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"} }
particulate(formulation)

local function shear(x, y, z) return y, 0, 0 end
boundary "*" { u = shear }

particle { shape = sphere { radius = 0.25 }, density = 1, at = {x0, y0, z0},
           hold = hold == "place" and {"x", "y", "z"} or {} }

results(function(r) return { omega = r.last["p0.omega_z"], u = r.last["p0.u"] } end)
