-- Flow round a cylinder in a channel (DFG benchmark, Schaefer and Turek 1996): case 2D-1, steady, Re = 20; with
-- --set case=2D-2 (or --set unsteady=true) Re = 100, periodic; with --set case=2D-3 the inflow rises and falls in 8 s.
-- Expect 2D-1: cd 5.5795, cl 0.01062, dp 0.1175. 2D-2: St 0.302, cd_max 3.227, cl from -1.021 to 0.987.
-- 2D-3 (John 2004, Int. J. Numer. Meth. Fluids 44:777): cd_max 2.95092 at 3.93625 s, cl_max 0.47795 at 5.69313 s, dp(8 s) -0.1116;
-- with steps of 10 / 5 ms 2.95073 / 2.95084 at 3.9347 / 3.9359 s, 0.4502 / 0.4739 at 5.739 / 5.705 s, -0.1088 / -0.1121; five minutes.
case "Flow round a cylinder (DFG 2D)"

local unsteady = param("unsteady", false, "2D-2 instead of 2D-1")
local kind = param("case", unsteady and "2D-2" or "2D-1", "2D-1, 2D-2 or 2D-3")
local dt = param("dt", kind == "2D-3" and 0.005 or 0.01, "time step of 2D-2 and 2D-3")
local stop = param("stop", 8, "end of 2D-2 and 2D-3")
local tolerance = param("tolerance", 0, "of steps that choose their length; 0: all are dt")

local steady = kind == "2D-1"
local umax, h, d = steady and 0.3 or 1.5, 0.41, 0.1
local mean = 2 / 3 * umax
if not (steady or kind == "2D-2" or kind == "2D-3") then error('case "' .. kind .. '": there are 2D-1, 2D-2 and 2D-3') end

mesh  { file = "mesh/cylinder2d.geo" }
fluid { density = 1, viscosity = 1e-3 }

term "continuity" {}
term "momentum" {}

boundary "inlet" { u = function(x, y, t)
  local u = 4 * umax * y * (h - y) / h ^ 2
  return kind == "2D-3" and u * math.sin(math.pi * t / 8) or u, 0
end }
boundary "outlet"   { natural = true }
boundary "walls"    { u = {0, 0} }
boundary "cylinder" { u = {0, 0} }

if not steady then
  if tolerance > 0 then time { tolerance = tolerance, stop = stop } else time { scheme = "bdf2", step = dt, stop = stop } end
end

output { every = dt * math.ceil(stop / dt / 20 - 1e-9), forces = {"cylinder"}, about = {0.2, 0.2},
         probes = { front = {0.15, 0.2}, rear = {0.25, 0.2} } }

results(function(r)
  local c = 2 / (mean ^ 2 * d)
  local t, fx, fy = r.t, r.series["cylinder.fx"], r.series["cylinder.fy"]
  local dp = r.last["front.p"] - r.last["rear.p"]
  if steady then return { cd = c * r.last["cylinder.fx"], cl = c * r.last["cylinder.fy"], dp = dp } end
  if kind == "2D-3" then
    local function most(f) -- the largest value and its time, by the parabola through it and its neighbours
      local k = 1
      for i = 2, #t do if f[i] > f[k] then k = i end end
      if k == 1 or k == #t then return c * f[k], t[k] end
      local a, b, m = f[k - 1] - f[k], f[k + 1] - f[k], t[k + 1] - t[k]
      local s = a + b < 0 and 0.5 * (a - b) / (a + b) or 0
      return c * (f[k] + 0.5 * s * (b - a) + 0.5 * s * s * (a + b)), t[k] + s * m
    end
    local cd, cd_at = most(fx)
    local cl, cl_at = most(fy)
    return { cd_max = cd, cd_at = cd_at, cl_max = cl, cl_at = cl_at, dp = dp }
  end
  -- largest values and period over the last quarter of the run
  local cd, high, low, first, last, crossings = 0, -1e9, 1e9, nil, nil, 0
  for i = 2, #t do
    if t[i] > 0.75 * stop then
      cd, high, low = math.max(cd, c * fx[i]), math.max(high, c * fy[i]), math.min(low, c * fy[i])
      if fy[i - 1] < 0 and fy[i] >= 0 then
        last = t[i - 1] + (t[i] - t[i - 1]) * fy[i - 1] / (fy[i - 1] - fy[i])
        first = first or last
        crossings = crossings + 1
      end
    end
  end
  local st = crossings > 1 and d / mean * (crossings - 1) / (last - first) or 0
  return { cd_max = cd, cl_max = high, cl_min = low, cl_amplitude = (high - low) / 2, strouhal = st }
end)
