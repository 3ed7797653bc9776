-- A channel that starts from rest and becomes steady.
case "Channel from rest"

mesh { box = {{0, 0}, {3, 1}}, cells = {12, 6} }
fluid { density = 1, viscosity = 0.05 }
term "continuity" {}
term "momentum" {}
boundary "*" { u = {0, 0} }
boundary "left" { u = function(x, y, t) return 4 * y * (1 - y), 0 end }
boundary "right" { natural = true }
time { tolerance = param("tolerance", 1e-3, "of steps"), stop = "steady", steady = param("steady", 1e-4, "change that is none"), at_most = param("at_most", 100, "end") }
output { probes = { mid = {1.5, 0.5} }}
results(function(r) return { u = r.last["mid.u"], n = #r.t } end)
