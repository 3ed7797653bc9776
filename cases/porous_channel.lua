-- Flow through a channel whose upper part, y > h, is a porous medium (Brinkman), pushed by a force.  Velocity and
-- shear are continuous at the edge: expect a parabola below, cosh and sinh of (y - h)/sqrt(K) in the medium, to third
-- order in the size of the cells.  --set h=0: the medium fills the channel.
case "Channel beside and through a porous medium"

local n = param("n", 16, "cells across, a multiple of 4")
local h = param("h", 0.5, "lower edge of the medium, a multiple of 1/4")
local K = param("K", 1e-2, "permeability")
local mu, force = param("mu", 0.1, "viscosity"), 1
local shape = param("shape", "quads", "quads or triangles")

mesh  { box = {{0, 0}, {0.5, 1}}, cells = {n / 2, n}, shape = shape }
fluid { density = 1, viscosity = mu }

term "continuity" {}
term "momentum" { force = {force, 0} }
if param("parts", false, "the medium is the part of the domain where its term acts") then
  term "porous" { inside = function(x, y) return y > h end, inverse_permeability = 1 / K }
else
  term "porous" { inverse_permeability = function(x, y) return y > h and 1 / K or 0 end }
end

boundary { periodic = {"left", "right"} }
boundary "*" { u = {0, 0} }

-- u = -F y^2/(2 mu) + a y below, F K/mu + c cosh + d sinh in the medium
local s, darcy = 1 / math.sqrt(K), force * K / mu
local function cosh(x) return (math.exp(x) + math.exp(-x)) / 2 end
local function sinh(x) return (math.exp(x) - math.exp(-x)) / 2 end
local C, S = cosh(s * (1 - h)), sinh(s * (1 - h))
-- d s = a - F h/mu;  c = a h - F h^2/(2 mu) - darcy;  darcy + c C + d S = 0
local a = (force * h ^ 2 / (2 * mu) * C + darcy * (C - 1) + force * h / mu * S / s) / (h * C + S / s)
local c, d = a * h - force * h ^ 2 / (2 * mu) - darcy, (a - force * h / mu) / s
local function u(x, y)
  if y < h then return a * y - force * y * y / (2 * mu), 0 end
  return darcy + c * cosh(s * (y - h)) + d * sinh(s * (y - h)), 0
end

exact  { u = u, p = 0 }
output { forces = {"bottom", "top"}, lines = { across = { from = {0.25, 0}, to = {0.25, 1}, points = 101 } } }

results(function(r) return { flow = r.mean.u[1], slip = select(1, u(0, h)) } end)
