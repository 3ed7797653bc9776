case "Channel, solved by KLU"
local n = param("n", 8, "cells across")
mesh  { box = {{0, 0}, {2, 1}}, cells = {2 * n, n} }
fluid { density = 1, viscosity = 1 }
term "continuity" {}
term "momentum" {}
boundary "left" { u = function(x, y) return {y * (1 - y), 0} end }
boundary "bottom" { u = {0, 0} }
boundary "top" { u = {0, 0} }
boundary "right" { natural = true }
solve { solver = "klu", ordering = "colamd", pivot = 0.01 }
