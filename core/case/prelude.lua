-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- What every case finds defined.  fail(text) is an error in the line of the case that is being run;
-- hint(name, list) is "; did you mean ...?" if a name of the list is near, else "".
local fail, hint = ...
local next, type, tostring, exp, huge = next, type, tostring, math.exp, math.huge
local sort, concat, format = table.sort, table.concat, string.format

-- pairs in a fixed order: numbers first, then strings
local rank = { number = 1, string = 2 }
local function before(a, b)
  local ra, rb = rank[type(a)] or 3, rank[type(b)] or 3
  if ra == rb then return ra < 3 and a < b end
  return ra < rb
end

function pairs(t)
  local keys, i = {}, 0
  for k in next, t do keys[#keys + 1] = k end
  sort(keys, before)
  return function() i = i + 1; if keys[i] ~= nil then return keys[i], t[keys[i]] end end
end
local pairs = pairs

-- Grid lines --------------------------------------------------------------------------------------------------

-- grid{0, 10, 0.5, 20, 2}: 10 equal cells from 0 to 0.5, 20 from 0.5 to 2
function grid(list)
  local ticks = {list[1]}
  for i = 1, #list - 2, 2 do
    local a, n, b = list[i], list[i + 1], list[i + 2]
    for k = 1, n do ticks[#ticks + 1] = a + (b - a) * k / n end
  end
  return ticks
end

-- graded(a, b, n, r): n cells from a to b, each r times as long as the one before
function graded(a, b, n, r)
  local ticks, x, h = {a}, 0, 1
  for k = 1, n do x = x + h; ticks[k + 1] = x; h = h * r end
  for k = 2, n + 1 do ticks[k] = a + (b - a) * ticks[k] / x end
  return ticks
end

-- clustered(a, b, n, s): n cells from a to b, finer at both ends; s > 0 says how much
function clustered(a, b, n, s)
  local ticks = {}
  local function tanh(z) local e = exp(2 * z); return (e - 1) / (e + 1) end
  for k = 0, n do ticks[k + 1] = a + (b - a) * 0.5 * (1 + tanh(s * (2 * k / n - 1)) / tanh(s)) end
  return ticks
end

-- Shapes of bodies --------------------------------------------------------------------------------------------

-- Every key of t is one of the valid ones.
local function check_keys(what, t, valid)
  local known = {}
  if type(t) ~= 'table' then
    fail(format('%s: expected its measures in braces, as in %s{%s = ...}, got %s', what, what, valid[1], type(t)))
  end
  for _, key in next, valid do known[key] = true end
  for key in pairs(t) do
    if type(key) ~= 'string' then
      fail(format('%s: a value without a name; valid keys: %s', what, concat(valid, ', ')))
    elseif not known[key] then
      local near = hint(key, valid)
      if key == 'diameter' and known.radius then near = '; did you mean "radius" (half of it)?' end
      fail(format('%s: unknown key "%s"%s%s valid keys: %s', what, key, near, near == '' and ';' or '',
        concat(valid, ', ')))
    end
  end
end

-- A length is positive, an exponent from 1 to 50 (beyond, edges are sharper than the quadrature of surfaces sees).
local function check_number(what, key, value)
  if value == nil then fail(format('%s: "%s" is missing', what, key)) end
  if type(value) ~= 'number' then fail(format('%s: "%s" must be a number, got a %s', what, key, type(value))) end
  if not (value < huge) then fail(format('%s: "%s" is %g; it must be finite', what, key, value)) end
  if key == 'exponent' or key == 'exponent_z' then
    if value < 1 or value > 50 then
      fail(format('%s: "%s" is %g; it must lie between 1 and 50 (sharp edges: rectangle{}, block{})', what, key, value))
    end
  elseif value <= 0 then
    fail(format('%s: "%s" is %g; it must be positive', what, key, value))
  end
end

-- Defines a shape in 2D or 3D by its keys (all numbers), and how it is made of them.  other: what a mesh of the
-- other dimension has for it.
local function shape(name, dim, other, keys, make, optional)
  local valid = {table.unpack(keys)}
  valid[#valid + 1] = optional
  _ENV[name] = function(t)
    check_keys(name, t, valid)
    for _, key in next, keys do check_number(name, key, t[key]) end
    if optional and t[optional] ~= nil then check_number(name, optional, t[optional]) end
    local s = make(t)
    s.name, s.dim, s.other = name, dim, other
    return s
  end
end

shape('disk', 2, 'sphere{}', {'radius'}, function(t)
  return { kind = 'ellipsoid', half = {t.radius, t.radius} }
end)
shape('ellipse', 2, 'ellipsoid{}', {'a', 'b'}, function(t)
  return { kind = 'ellipsoid', half = {t.a, t.b} }
end)
shape('rectangle', 2, 'block{}', {'width', 'height'}, function(t)
  return { kind = 'box', half = {t.width / 2, t.height / 2} }
end)
shape('superellipse', 2, 'superellipsoid{}', {'a', 'b', 'exponent'}, function(t)
  return { kind = 'superellipsoid', half = {t.a, t.b}, exponent = {t.exponent, t.exponent} }
end)
shape('sphere', 3, 'disk{}', {'radius'}, function(t)
  return { kind = 'ellipsoid', half = {t.radius, t.radius, t.radius} }
end)
shape('ellipsoid', 3, 'ellipse{}', {'a', 'b', 'c'}, function(t)
  return { kind = 'ellipsoid', half = {t.a, t.b, t.c} }
end)
shape('block', 3, 'rectangle{}', {'width', 'height', 'depth'}, function(t)
  return { kind = 'box', half = {t.width / 2, t.height / 2, t.depth / 2} }
end)
shape('cylinder', 3, 'disk{} or rectangle{}', {'radius', 'length'}, function(t)
  return { kind = 'cylinder', half = {t.radius, t.radius, t.length / 2} }
end)
shape('superellipsoid', 3, 'superellipse{}', {'a', 'b', 'c', 'exponent'}, function(t)
  return { kind = 'superellipsoid', half = {t.a, t.b, t.c}, exponent = {t.exponent, t.exponent_z or t.exponent} }
end, 'exponent_z')

-- body { distance = function(x, y[, z]), half = {...} }: half widths of a box round the origin that holds it
function body(t)
  check_keys('body', t, {'distance', 'half'})
  if type(t.distance) ~= 'function' then
    fail('body: "distance" must be a function of x, y[, z], the signed distance, got ' .. type(t.distance))
  end
  if type(t.half) ~= 'table' then
    fail('body: "half" must be the half widths of a box that holds the body, {x, y[, z]}, got ' .. type(t.half))
  end
  for k = 1, #t.half do check_number('body', 'half[' .. k .. ']', t.half[k]) end
  return { kind = 'distance', half = t.half, distance = t.distance }
end

-- Formulations of particulate flow: the lines that they stand for ----------------------------------------------

local kernel_fluid, term, offset = fluid, term, offset
local formulations = {'sharp', 'conservative', 'appendix'}
local given, chosen

function fluid(t)
  kernel_fluid(t)
  given = t
end

-- The pressure is solved for without its hydrostatic part: files show p + rho g.x.  What is wrong with gravity or
-- density is said where fluid{} is read.
local function add_hydrostatic(g, rho)
  if type(g) ~= 'table' or type(rho) ~= 'number' then return end
  local gx, gy, gz = g[1], g[2], g[3]
  if type(gx) ~= 'number' or type(gy) ~= 'number' or (gz ~= nil and type(gz) ~= 'number') then return end
  if gz then offset { p = function(x, y, z) return rho * (gx * x + gy * y + gz * z) end }
  else offset { p = function(x, y) return rho * (gx * x + gy * y) end } end
end

function particulate(name, options)
  if not given then
    fail('particulate: fluid{} must stand before it; put particulate after fluid{}')
  elseif chosen then
    fail(format('particulate: a second one; the formulation is "%s" already', chosen))
  elseif options ~= nil and type(options) ~= 'table' then
    fail(format('particulate: the options of "%s" must be a table in braces, got a %s', tostring(name), type(options)))
  elseif name == 'conservative' and options and next(options) ~= nil then
    fail('particulate: "conservative" has no options')
  end
  if name == 'appendix' then
    term 'appendix' (options or {})
  elseif name == 'conservative' then
    term 'multiplier' {}
    term 'rigid_body' {}
    term 'continuity.pressure_smoothing' {}
  elseif name == 'sharp' then
    given.region = 'outside'
    term 'surface' (options or {})
    term 'rigid_body' { without = {'displaced'} }
    term 'rigid_body.buoyancy' {}
  else
    fail(format('particulate: expected "sharp", "conservative" or "appendix", got %s%s',
      type(name) == 'string' and '"' .. name .. '"' or type(name),
      type(name) == 'string' and hint(name, formulations) or ''))
  end
  chosen = name
  if name == 'appendix' then return end
  given.reduced_pressure = true
  add_hydrostatic(given.gravity, given.density)
end
