-- Dipole
case "A dipole turns into a field"
local n = param("n", 16, "cells")
local theta = param("theta", 2, "angle at the start")
local moment = param("moment", 0.05, "of the dipole")
local dt = param("dt", 0.05, "step")
mesh  { box = {{0, 0}, {1, 1}}, cells = {n, n} }
fluid { density = 1, viscosity = 1 }
term "continuity" {}
term "momentum" {}
particulate "sharp"
term "electro.torque" { field = {1, 0} }
boundary "*" { u = {0, 0} }
particle { shape = disk { radius = 0.2 }, density = 1, at = {0.5, 0.5}, angle = theta, moment = {moment, 0} }
time   { scheme = "bdf2", step = dt, stop = 1 }
results(function(r) return { angle = r.last["p0.angle"], omega = r.last["p0.omega"], torque = r.last["p0.torque"] } end)
