-- A power-law fluid, n = 1/2, through a channel of width 1, driven by a force of 1.
case "power-law channel"
mesh  { box = {{0, 0}, {1, 1}}, cells = {2, 16} }
fluid { density = 1 }
term "continuity" {}
term "momentum" { without = {"viscous", "pressure_gradient"}, force = {1, 0} }
term "gnf" { model = "power_law", consistency = param("consistency", 1, "K"), n = 0.5, eps = 1e-4 }
boundary { periodic = {"left", "right"} }
boundary "*" { u = {0, 0} }
exact { u = function(x, y) return (0.5 ^ 3 - math.abs(y - 0.5) ^ 3) / 3, 0 end }
