-- Two equal dipoles that turn into the line between them.  Their torques are the same, not opposite: the forces make
-- up for it.  With both at the angle theta to the line, tan(theta) falls like exp(-4 k m^2 t / (r^2 zeta)).
case "Two dipoles"

local n = param("n", 12, "cells per m")
local theta = param("theta", 1.2, "angle of both at the start, rad")
local spin = param("spin", 0, "at the start: without inertia the rate that steady=true gives, rad/s")
local steady = param("steady", false, "only the rate at the start")
local dt = param("dt", 0.1, "time step, s")

mesh  { box = {{0, 0}, {1.5, 1}}, cells = {1.5 * n, n} }
fluid { density = 1e-6, viscosity = 1 }

term "continuity" {}
term "momentum" {}
particulate "sharp"
term "electro.dipoles" { constant = 0.05 }

boundary "*" { u = {0, 0} }

for i = 0, 1 do
  particle { shape = disk { radius = 0.15 }, density = 1e-6, at = {0.5 + 0.5 * i, 0.5}, angle = theta, spin = spin,
             moment = {0.8, 0}, hold = {"x", "y"} }
end

if not steady then time { scheme = "bdf2", step = dt, stop = 2 } end

results(function(r)
  return { angle = r.last["p0.angle"], other_angle = r.last["p1.angle"], omega = r.last["p0.omega"],
           torque = r.last["p0.torque"], other_torque = r.last["p1.torque"], fx = r.last["p1.contact_x"],
           fy = r.last["p1.contact_y"], other_fy = r.last["p0.contact_y"] }
end)
