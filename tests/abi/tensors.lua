-- Fields of tensors, quadratic in space and linear in time, so that they lie in the spaces: every component has
-- another polynomial.  --set dim=3, --set simplex=true, --set symmetry=true: x = 0 is a mirror.
local dim, simplex = param("dim", 2, ""), param("simplex", false, "")
local symmetry, periodic = param("symmetry", false, ""), param("periodic", false, "")
local step = 0.5

mesh { box = dim == 3 and {{0, 0, 0}, {1, 2, 1}} or {{0, 0}, {1, 2}}, cells = dim == 3 and {2, 2, 1} or {3, 4},
       shape = dim == 3 and (simplex and "tets" or "hexes") or (simplex and "triangles" or "quads") }
term "tensors" { f = function(x, y, z, t) return F(x, y, z, t) end, g = function(x, y, z, t) return T(x, y, z, t) end }

local pairs_of, all = {}, {}
for a = 1, dim do
  for b = 1, dim do
    all[#all + 1] = {a, b}
    if a <= b then pairs_of[#pairs_of + 1] = {a, b} end
  end
end

-- component (a, b) of S: c + l.x + x.Q x + r t, its slopes and Laplacian; odd in x if one of a, b is 1, else even
local function terms(a, b, seed)
  local function number(k) return ((seed * 37 + a * 11 + b * 5 + k * 7) % 13 - 6) / 4 end
  local odd = symmetry and (a == 1) ~= (b == 1)
  local even = symmetry and not odd
  local c, l, q = odd and 0 or number(0), {}, {}
  for k = 1, dim do
    l[k] = number(k)
    q[k] = {}
    for m = k, dim do q[k][m] = number(4 + 3 * k + m) end
  end
  if odd then
    for k = 2, dim do l[k] = 0; for m = k, dim do q[k][m] = 0 end end
    q[1][1] = 0
  elseif even then
    l[1] = 0
    for m = 2, dim do q[1][m] = 0 end
  end
  if periodic then l[1] = 0; for m = 1, dim do q[1][m] = 0 end end
  return c, l, q, odd and 0 or number(3)
end
local function value(a, b, seed, x, t)
  local c, l, q, r = terms(a, b, seed)
  local v = c + r * t
  for k = 1, dim do
    v = v + l[k] * x[k]
    for m = k, dim do v = v + q[k][m] * x[k] * x[m] end
  end
  return v
end
local function slope(a, b, seed, x, k)
  local _, l, q = terms(a, b, seed)
  local v = l[k]
  for m = 1, dim do
    local i, j = math.min(k, m), math.max(k, m)
    v = v + q[i][j] * x[m] * (m == k and 2 or 1)
  end
  return v
end
local function laplacian(a, b, seed)
  local _, _, q = terms(a, b, seed)
  local v = 0
  for k = 1, dim do v = v + 2 * q[k][k] end
  return v
end
local function S(a, b) return a <= b and {a, b} or {b, a} end

-- a function of x, y[, z], t with one number for each of the pairs
local function field(list, f)
  return function(x, y, z, t)
    if dim == 2 then z, t = 0, z end
    local out, at = {}, {x, y, z}
    for i, p in ipairs(list) do out[i] = f(p[1], p[2], at, t or 0) end
    return table.unpack(out)
  end
end
F = field(pairs_of, function(a, b) local _, _, _, r = terms(a, b, 1); return r - laplacian(a, b, 1) end)
T = field(all, function(a, b, x, t) return value(a, b, 2, x, t) end)
local s = field(pairs_of, function(a, b, x, t) return value(a, b, 1, x, t) end)

exact { S = s, T = T,
  G = field(all, function(a, k, x)
    local v = 0
    for b = 1, dim do local p = S(a, b); v = v + b * slope(p[1], p[2], 1, x, k) end
    return v
  end),
  H = field(pairs_of, function(a, b, x)
    local v = 0
    for k = 1, dim do v = v + k * (slope(a, b, 2, x, k) + 2 * slope(b, a, 2, x, k)) end
    return v
  end),
  L = field(pairs_of, function(a, b, x, t) return laplacian(a, b, 1) + value(a, b, 1, x, t - step) end) }
initial { S = s }
if symmetry then boundary "left" { symmetry = true } end
if periodic then boundary { periodic = {"left", "right"} } end
boundary "*" { S = s }
time { step = step, stop = 1 }
output { probes = { middle = dim == 3 and {0.5, 1, 0.5} or {0.5, 1} },
         lines = { along = { from = dim == 3 and {0, 0, 0} or {0, 0}, to = dim == 3 and {1, 2, 1} or {1, 2}, points = 5 } } }
solve { tolerance = 1e-13 }
