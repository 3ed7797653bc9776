-- A channel whose inflow doubles at once at a time that no step foresees.
case "Inflow that jumps"

local at = param("at", 0.4123, "when it jumps")
mesh { box = {{0, 0}, {3, 1}}, cells = {12, 6} }
fluid { density = 1, viscosity = 0.05 }
term "continuity" {}
term "momentum" {}
boundary "*" { u = {0, 0} }
boundary "left" { u = function(x, y, t) return 4 * y * (1 - y) * (t < at and 1 or 2), 0 end }
boundary "right" { natural = true }
initial { u = function(x, y) return 4 * y * (1 - y), 0 end }
time { tolerance = param("tolerance", 1e-3, "of steps"), stop = 2 }
output { every = 2, tables_every = 0.1, probes = { mid = {1.5, 0.5} }, forces = {"left"} }
results(function(r) return { u = r.last["mid.u"], n = #r.t } end)
