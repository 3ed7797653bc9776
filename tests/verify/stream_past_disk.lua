-- A stream through a periodic box with a fixed disk in it, left to itself: its kinetic energy can only fall. On a mesh that does not
-- resolve it; cell Reynolds numbers from 1 to 1000.
case "A stream that a disk slows down"

local n = param("n", 16, "cells in each direction; 4 across the disk")
local re = param("re", 100, "cell Reynolds number")
local stop = param("stop", 4, "end")
local tolerance = param("tolerance", 1e-2, "of steps")
local stabilise = param("stabilise", true, "the terms under test")

mesh  { box = {{0, 0}, {1, 1}}, cells = {n, n} }
fluid { density = 1, viscosity = 1 / n / re }
term "continuity" {}
term "momentum" {}
particulate "sharp"
if stabilise then term "stabilise" {} end
boundary { periodic = {"left", "right"} }
boundary { periodic = {"bottom", "top"} }
particle { shape = disk { radius = 0.125 }, density = 1, at = {0.503, 0.497}, motion = "fixed" }
initial { u = {1, 0.1} }
time { tolerance = tolerance, stop = stop }
output { every = stop }
