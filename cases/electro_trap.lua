-- A disk in a trap, k (x - x0), in a closed box of viscous fluid: zeta(x) x' = -k (x - x0).  --set steady=true gives
-- the velocity at the start.
case "A disk in a trap"

local n = param("n", 16, "cells")
local x = param("x", 0.62, "place at the start, m")
local u = param("u", 0, "at the start: without inertia the velocity that steady=true gives, m/s")
local steady = param("steady", false, "only the velocity at the start")
local dt = param("dt", 0.05, "time step, s")

mesh  { box = {{0, 0}, {1, 1}}, cells = {n, n} }
fluid { density = 1e-6, viscosity = 1 }

term "continuity" {}
term "momentum" {}
particulate "sharp"
term "electro.trap" { stiffness = 40, centre = {0.5, 0.5} }

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = 0.15 }, density = 1e-6, at = {x, 0.5}, velocity = {u, 0} }

if not steady then time { scheme = "bdf2", step = dt, stop = 1 } end

results(function(r) return { x = r.last["p0.x"], y = r.last["p0.y"], u = r.last["p0.u"] } end)
