-- A dipole that a field turns in a viscous fluid: zeta theta' = -m E sin(theta), so tan(theta/2) falls like
-- exp(-m E t / zeta).  --set steady=true gives the rate at the start, from which zeta is known.
case "A compass in a field"

local n = param("n", 12, "cells")
local theta = param("theta", 2.4, "angle at the start, rad")
local moment = param("moment", 0.9, "of the dipole, C")
local spin = param("spin", 0, "at the start: without inertia the rate that steady=true gives, rad/s")
local steady = param("steady", false, "only the rate at the start")
local dt = param("dt", 0.1, "time step, s")

mesh  { box = {{0, 0}, {1, 1}}, cells = {n, n} }
fluid { density = 1e-6, viscosity = 1 }

term "continuity" {}
term "momentum" {}
particulate "sharp"
term "electro.torque" { field = {1, 0} }

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = 0.2 }, density = 1e-6, at = {0.5, 0.5}, angle = theta, spin = spin, moment = {moment, 0} }

if not steady then time { scheme = "bdf2", step = dt, stop = 2 } end

results(function(r) return { angle = r.last["p0.angle"], omega = r.last["p0.omega"], torque = r.last["p0.torque"] } end)
