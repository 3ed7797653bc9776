-- Flow round a cylinder in a channel (DFG benchmark, Schaefer and Turek 1996): 2D-1, steady, Re = 20;
-- with --set unsteady=true 2D-2, Re = 100. Expect cd 5.5795, cl 0.01062, dp 0.1175; 2D-2: St 0.302, cd_max 3.227, cl from -1.021 to 0.987.
case "Flow round a cylinder (DFG 2D)"

local unsteady = param("unsteady", false, "2D-2 instead of 2D-1")
local dt = param("dt", 0.01, "time step of 2D-2")
local stop = param("stop", 8, "end of 2D-2")

local umax, h, d = unsteady and 1.5 or 0.3, 0.41, 0.1
local mean = 2 / 3 * umax

mesh  { file = "mesh/cylinder2d.geo" }
fluid { density = 1, viscosity = 1e-3 }

term "continuity" {}
term "momentum" {}

boundary "inlet"    { u = function(x, y) return 4 * umax * y * (h - y) / h ^ 2, 0 end }
boundary "outlet"   { natural = true }
boundary "walls"    { u = {0, 0} }
boundary "cylinder" { u = {0, 0} }

if unsteady then
  time { scheme = "bdf2", step = dt, stop = stop }
end

output { every = dt * math.ceil(stop / dt / 20 - 1e-9), forces = {"cylinder"}, about = {0.2, 0.2},
         probes = { front = {0.15, 0.2}, rear = {0.25, 0.2} } }

results(function(r)
  local c = 2 / (mean ^ 2 * d)
  if not unsteady then
    return { cd = c * r.last["cylinder.fx"], cl = c * r.last["cylinder.fy"], dp = r.last["front.p"] - r.last["rear.p"] }
  end
  -- largest values and period over the last quarter of the run
  local t, fx, fy = r.t, r.series["cylinder.fx"], r.series["cylinder.fy"]
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
