-- A neutrally buoyant disk between two walls that move in opposite directions, Re = U H / nu = 40 (U: difference of their
-- velocities): it turns, and drifts from a quarter of the height to the middle (Feng, Hu and Joseph 1994, J. Fluid Mech. 277:271).
-- Expect y / H at t U / H = 20, 40, 60, 80: 0.339 to 0.349, 0.415 to 0.423, 0.460 to 0.464, 0.482 (two of their curves), in a box one
-- H long; the default mesh gives 0.338, 0.412, 0.455, in half a minute.
case "Disk drifting in Couette flow"

local n = param("n", 16, "cells across; d / h = n / 4")
local dt = param("dt", 0.1, "time step, in H / U")
local stop = param("stop", 60, "end, in H / U")
local length = param("length", 1, "period along the walls, in H")
local re = param("re", 40, "Reynolds number")
local formulation = param("formulation", "sharp", "sharp or conservative")

mesh  { box = {{0, 0}, {length, 1}}, cells = {math.ceil(length * n), n} }
fluid { density = 1, viscosity = 1 / re }

term "continuity" {}
term "momentum" {}
particulate(formulation)

boundary "bottom" { u = {-0.5, 0} }
boundary "top"    { u = {0.5, 0} }
boundary { periodic = {"left", "right"} }

particle { shape = disk { radius = 0.125 }, density = 1, at = {0.5 * length, 0.25} }

initial { u = function(x, y) return y - 0.5, 0 end }
time    { scheme = "bdf2", step = dt, stop = stop }
output  { every = dt * math.ceil(stop / dt / 12 - 1e-9) }

results(function(r)
  local y, out = r.series["p0.y"], { y = r.last["p0.y"], omega = r.last["p0.omega"] }
  local next = 20
  for i = 1, #y do -- the height at whole twenties
    if r.t[i] >= next - 1e-9 then out["y_" .. next], next = y[i], next + 20 end
  end
  return out
end)
