-- A neutrally buoyant disk in a shear flow between two moving walls, Stokes flow: it turns with half the shear rate.
-- Expect omega / shear rate = -0.5 within 2.5 % at D/h = 11 (n = 28).
case "Disk in shear"

local n = param("n", 28, "cells in each direction; D/h = 0.4 n")
local x0, y0 = param("x0", 0.013, "centre"), param("y0", 0.0091, "centre")
local formulation = param("formulation", "sharp", "sharp or conservative")

mesh  { box = {{-0.5, -0.5}, {0.5, 0.5}}, cells = {n, n} }
fluid { density = 1, viscosity = 1 }

term "continuity" {}
term "momentum" { without = {"convection"} }
particulate(formulation)

local function shear(x, y) return y, 0 end
boundary "*" { u = shear }

particle { shape = disk { radius = 0.2 }, density = 1, at = {x0, y0} }

results(function(r) return { omega = r.last["p0.omega"], u = r.last["p0.u"], v = r.last["p0.v"] } end)
