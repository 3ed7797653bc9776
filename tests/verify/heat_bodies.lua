-- Bodies in a fluid at rest with exact temperatures: MODE is isothermal (T = ln r outside), flux (the same by its flux),
-- source (heat made inside), sphere (a conducting sphere in a linear temperature) or equal (heat goes over in a closed box).
case "Exact temperatures round bodies"

local mode = param("mode", "isothermal", "isothermal, flux, source, sphere or equal")
local n = param("n", 16, "cells in each direction")
local shape = param("shape", "quads", "quads, triangles, hexes or tets")
local kb, kf, Q, R = 10, 2, 3, 0.27
local c = {0.013, 0.0091, mode == "sphere" and -0.007 or nil}
local d3 = mode == "sphere"

local function r(x, y) return math.sqrt((x - c[1]) ^ 2 + (y - c[2]) ^ 2) end

local function outside(x, y, z)
  if mode == "source" then return -Q * R ^ 2 / (2 * kf) * math.log(r(x, y) / R) end
  if not d3 then return math.log(r(x, y)) end
  local x, y, z = x - c[1], y - c[2], z - c[3]
  return x * (1 - (kb - kf) / (kb + 2 * kf) * R ^ 3 / (x ^ 2 + y ^ 2 + z ^ 2) ^ 1.5)
end

local function inside(x, y)
  if d3 then return 3 * kf / (kb + 2 * kf) * (x - c[1]) end
  return Q * (R ^ 2 - r(x, y) ^ 2) / (4 * kb)
end

if d3 then
  mesh { box = {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, cells = {n, n, n}, shape = shape == "quads" and "hexes" or shape }
else
  mesh { box = {{-0.5, -0.5}, {0.5, 0.5}}, cells = {n, n}, shape = shape }
end
fluid { density = 1.5, conductivity = kf, heat_capacity = 2 }

term "heat" { without = {"advection", "buoyancy"} }
if mode == "isothermal" then term "heat_bodies.surface_temperature" { temperature = math.log(R) } end
if mode == "flux" then term "heat_bodies.surface_flux" { heat_flux = -kf / R } end
if mode == "source" then term "heat_bodies" { body_conductivity = kb, heat_source = Q } end
if mode == "sphere" then term "heat_bodies" { body_conductivity = kb } end
if mode == "equal" then term "heat_bodies" { body_conductivity = kb, body_heat_capacity = 4 } end

particle { shape = d3 and sphere { radius = R } or disk { radius = R }, density = 3, at = c, motion = "fixed" }

if mode == "equal" then -- T = 0 in the fluid and 1 in the disk: at last the same everywhere
  local a = 3 * 4 * math.pi * R ^ 2
  local T = a / (a + 1.5 * 2 * (1 - math.pi * R ^ 2))
  boundary "*" { natural = true }
  initial { T_body = 1 }
  exact   { T = T, T_body = T }
  time    { scheme = "bdf2", step = 0.1, stop = 20 }
else
  boundary "*" { T = outside }
  exact { T = outside, T_body = (mode == "source" or d3) and inside or nil }
  output { forces = {"left", "right", "bottom", "top"} }
end

results(function(r)
  local heat = 0
  if mode == "source" then
    for _, side in ipairs {"left", "right", "bottom", "top"} do heat = heat + r.last[side .. ".heat"] end
  end
  return { heat = heat / (Q * math.pi * R ^ 2) }
end)
