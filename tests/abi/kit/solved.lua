-- The smallest flow, by a linear solver that the command line has to bring.
case "solved"

mesh  { box = {{0, 0}, {1, 1}}, cells = {2, 2} }
fluid { density = 1, viscosity = 1 }

term "continuity" {}
term "momentum" {}

boundary "top" { u = {1, 0} }
boundary "*"   { u = {0, 0} }

solve { solver = "declines" }
