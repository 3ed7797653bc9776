-- SPDX-License-Identifier: GPL-3.0-or-later
-- The lid-driven cavity with the convection of a plugin of this folder, for what a run says about it.
case "Cavity with another convection"

local n = param("n", 12, "cells each way")

mesh  { box = {{0, 0}, {1, 1}}, cells = {n, n} }
fluid { density = 1, viscosity = 0.03 }
term "continuity" {}
term "momentum" { without = {"convection"} }
term "broken" { order = 4, f = {0, 0} }

boundary "top" { u = {1, 0} }
boundary "*"   { u = {0, 0} }
