-- A driven cavity filled with a porous medium.
case "porous cavity"
mesh  { box = {{0, 0}, {1, 1}}, cells = {3, 3} }
fluid { density = 1, viscosity = 1 }
term "continuity" {}
term "momentum" {}
term "drag" { permeability = 0.1 }
boundary "top" { u = {1, 0} }
boundary "*"   { u = {0, 0} }
