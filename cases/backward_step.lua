-- Flow over a backward-facing step, Re = 800 with the mean velocity of the inflow and the height of the channel, H = 1
-- (Gartling 1990, Int. J. Numer. Meth. Fluids 11:953). Half of the left side is the face of the step, the other half lets a
-- parabola in; --set mesh=channel has an inlet channel of length 2 upstream instead (Gmsh).
-- Expect, in H: the eddy behind the step ends at 6.10, the one at the upper wall reaches from 4.85 to 10.48; with an inlet
-- channel 5.92, and 4.74 to 10.28 (Erturk 2008, Comput. Fluids 37:633). Newton goes from rest by continuation, by itself.
case "Flow over a backward-facing step"

local re = param("re", 800, "Reynolds number")
local n = param("n", 16, "cells across the channel, an even number")
local kind = param("mesh", "box", "box (inflow at the step) or channel (inlet upstream of it)")
local length, fine = 30, 15 -- cells 2.5 / n long up to `fine`, from there on twice as long

if kind ~= "box" and kind ~= "channel" then error('mesh "' .. kind .. '": there are box and channel') end
if kind == "channel" and n ~= 16 then error("n: the cells of the mesh with a channel are set in mesh/backward_step.geo") end
if n % 2 ~= 0 then error("n = " .. n .. ": an even number puts the corner of the step on a node") end

if kind == "channel" then
  mesh { file = "mesh/backward_step.geo" }
else
  local along = grid { 0, math.ceil(0.4 * fine * n), fine, math.ceil(0.2 * (length - fine) * n), length }
  mesh { box = {{0, -0.5}, {length, 0.5}}, cells = {along, n} }
end
fluid { density = 1, viscosity = 1 / re }

term "continuity" {}
term "momentum" {}

local function inflow(x, y) return y > 0 and 24 * y * (0.5 - y) or 0, 0 end

if kind == "channel" then
  boundary "walls"  { u = {0, 0} }
  boundary "inlet"  { u = inflow }
  boundary "outlet" { natural = true }
else
  boundary "left"   { u = inflow }
  boundary "right"  { natural = true }
  boundary "bottom" { u = {0, 0} }
  boundary "top"    { u = {0, 0} }
end

-- Within a cell u is a parabola in y: two points of the first layer give its slope at the wall. The places are those where
-- the slope is expected to change its sign at Re = 800; for other Re the lines along the walls tell.
local h = kind == "channel" and 1 / 16 or 1 / n
local near = { low = {5.4, 6.6}, sep = {4.3, 5.3}, top = {9.8, 11} } -- ranges of x
local count, at, lines = 10, {}, {}
local function place(wall, i) return near[wall][1] + (near[wall][2] - near[wall][1]) * (i - 1) / (count - 1) end
for wall in pairs(near) do
  local y, up = wall == "low" and -0.5 or 0.5, wall == "low" and 1 or -1
  for i = 1, count do
    for j = 1, 2 do at[("%s%d_%d"):format(wall, j, i)] = {place(wall, i), y + 0.5 * up * h * j} end
  end
end
for j = 1, 2 do
  lines["low" .. j] = { from = {0, -0.5 + 0.5 * h * j}, to = {15, -0.5 + 0.5 * h * j}, points = 301 }
  lines["top" .. j] = { from = {0, 0.5 - 0.5 * h * j}, to = {15, 0.5 - 0.5 * h * j}, points = 301 }
end
for _, x in ipairs { 7, 15 } do lines["x" .. x] = { from = {x, -0.5}, to = {x, 0.5}, points = 41 } end

output { probes = at, lines = lines }

results(function(r)
  local function shear(wall, i)
    return (4 * r.last[("%s1_%d.u"):format(wall, i)] - r.last[("%s2_%d.u"):format(wall, i)]) / h
  end
  local function zero(wall) -- where the slope changes its sign
    for i = 2, count do
      local a, b = shear(wall, i - 1), shear(wall, i)
      if a * b < 0 then return place(wall, i - 1) + (place(wall, i) - place(wall, i - 1)) * a / (a - b) end
    end
    return "outside of the range"
  end
  return { reattachment = zero("low"), upper_separation = zero("sep"), upper_reattachment = zero("top") }
end)
