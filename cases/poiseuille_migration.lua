-- A neutrally buoyant disk in plane Poiseuille flow: it drifts to a place between wall and middle, which in pipes is the effect
-- of Segre and Silberberg (Pan and Glowinski 2002, J. Comput. Phys. 181:260; Feng, Hu and Joseph 1994, J. Fluid Mech. 277:271).
-- All is at rest at first, a constant slope of the pressure drives the flow. Expect y / H = 0.363, 0.295, 0.2695, 0.2712 after
-- ways of 5, 10, 15, 20 H, and 0.2723 in the end; the default mesh gives 0.362, 0.295, 0.2691, 0.2708, in a minute and a half.
case "Disk drifting in Poiseuille flow"

local n = param("n", 16, "cells across; d / h = n / 4")
local dt = param("dt", 0.5, "time step")
local stop = param("stop", 600, "end")
local length = param("length", 1, "period along the walls, in H")
local y0 = param("y0", 0.4, "height at the start")
local formulation = param("formulation", "sharp", "sharp or conservative")

mesh  { box = {{0, 0}, {length, 1}}, cells = {math.ceil(length * n), n} }
-- The pressure falls by `slope` a length. What is periodic is the rest of it, so the slope stands as a force: on the fluid, and
-- on the body, where a part of its density that is too small to matter has a weight, slope times volume. Without sharp surfaces
-- there is fluid, and so the force, in the body as well.
local slope = 2.337e-4
local excess = formulation == "sharp" and 1e-4 or 0

fluid { density = 1, viscosity = 1 / 2334, gravity = {excess > 0 and slope / excess or 0, 0} }

term "continuity" {}
term "momentum" { force = {slope, 0} }
particulate(formulation)

boundary "bottom" { u = {0, 0} }
boundary "top"    { u = {0, 0} }
boundary { periodic = {"left", "right"} }

particle { shape = disk { radius = 0.125 }, density = 1 + excess, at = {0.5 * length, y0} }

time   { scheme = "bdf2", step = dt, stop = stop }
output { every = dt * math.ceil(stop / dt / 12 - 1e-9) }

results(function(r)
  local t, u, y = r.t, r.series["p0.u"], r.series["p0.y"]
  local way, next, out = 0, 5, {}
  for i = 2, #t do -- the height after ways of 5, 10, 15, ...
    way = way + 0.5 * (t[i] - t[i - 1]) * (u[i] + u[i - 1])
    if way >= next then out["y_" .. next], next = y[i], next + 5 end
  end
  out.way, out.y, out.omega = way, r.last["p0.y"], r.last["p0.omega"]
  return out
end)
