-- Flow round a cylinder in a square channel, three-dimensional (DFG 3D-1Z, Re = 20, steady).
-- Expect cd 6.05 to 6.25 and cl 0.008 to 0.01 on fine meshes; the default mesh is coarse and a few per cent off.
case "Flow round a cylinder (DFG 3D-1Z)"

local umax, h, d = 0.45, 0.41, 0.1
local mean = 4 / 9 * umax

mesh  { file = "mesh/cylinder3d.geo", dim = 3 }
fluid { density = 1, viscosity = 1e-3 }

term "continuity" {}
term "momentum" {}

boundary "inlet"    { u = function(x, y, z) return 16 * umax * y * z * (h - y) * (h - z) / h ^ 4, 0, 0 end }
boundary "outlet"   { natural = true }
boundary "walls"    { u = {0, 0, 0} }
boundary "cylinder" { u = {0, 0, 0} }

output { forces = {"cylinder"}, probes = { front = {0.45, 0.2, 0.205}, rear = {0.55, 0.2, 0.205} } }

results(function(r)
  local c = 2 / (mean ^ 2 * d * h)
  return { cd = c * r.last["cylinder.fx"], cl = c * r.last["cylinder.fy"], dp = r.last["front.p"] - r.last["rear.p"] }
end)
