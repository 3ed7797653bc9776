case "gs"
local n = param("n", 4, "cells")
local sh = param("shift", 0, "")
local pv = param("pivoting", true, "")
mesh { box = {{0, 0}, {2, 1}}, cells = {2*n, n} }
fluid { density = 1, viscosity = 0.5 }
term "continuity" {}
term "momentum" {}
boundary "left" { u = function(x, y) return y * (1 - y), 0 end }
boundary "right" { natural = true }
boundary "*" { u = {0, 0} }
solve { solver = "gs", pivoting = pv, shift = sh }
results(function(r) return { p = r.mean.p[1] } end)
