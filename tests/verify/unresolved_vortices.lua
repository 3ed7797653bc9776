-- Taylor-Green vortices in a mean flow, disturbed, on a few cells: at a large Reynolds number of the cell the energy
-- must not grow by itself.  errors.u.l2 is the norm of u, so that the energy is half of its square.
case "Vortices that the mesh does not resolve"

local n = param("n", 8, "cells in each direction")
local reynolds = param("cell_reynolds", 1000, "U h/nu")
local stop = param("stop", 8, "end")
local stabilise = param("stabilise", true, "with the terms of stabilise")
local streamline = param("streamline", 0, "strength of stabilise.streamline; 0: off")
local shape = param("shape", "quads", "quads or triangles")
local sin, cos, pi = math.sin, math.cos, math.pi

mesh  { box = {{0, 0}, {2 * pi, 2 * pi}}, cells = {n, n}, shape = shape }
fluid { density = 1, viscosity = 2 * pi / n / reynolds }

term "continuity" {}
term "momentum" {}
if stabilise then term "stabilise" {} end
if streamline > 0 then term "stabilise.streamline" { streamline = streamline } end

boundary { periodic = {"left", "right"} }
boundary { periodic = {"bottom", "top"} }

initial {
  u = function(x, y)
    return 0.5 + sin(x) * cos(y) + 0.2 * sin(2 * y + 1), 0.3 - cos(x) * sin(y) + 0.2 * cos(3 * x)
  end,
}
exact  { u = {0, 0} }
time   { scheme = "bdf2", step = 0.05, stop = stop }
output { every = stop }
