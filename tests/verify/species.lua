-- Species with known concentrations, --set kind=NAME.
local kind, n = param("kind", "layer", ""), param("n", 8, "cells along x")
local shape, streamline = param("shape", "quads", ""), param("streamline", false, "")
local dt = param("dt", 0.1, "")
local exp = math.exp

local function box(flow)
  mesh { box = {{0, 0}, {1, 0.5}}, cells = {n, 3}, shape = shape }
  fluid { density = flow and 1 or nil, viscosity = flow and 1 or nil, diffusivity = 0.1, first_order = 0.9,
          second_order = 2, max_rate = 3, half_saturation = 0.5 }
  if flow then term "continuity" {} term "momentum" {} end
  term "species" { without = not flow and {"advection"} or nil }
end

if kind == "layer" then -- what a stream carries against diffusion, Peclet number 10
  mesh { box = {{0, 0}, {1, 0.5}}, cells = {n, 3}, shape = shape }
  fluid { density = 1, viscosity = 1, diffusivity = 0.1 }
  term "continuity" {} term "momentum" {} term "species" {}
  boundary "left" { u = {1, 0}, c = 0 }
  boundary "right" { u = {1, 0}, c = 1 }
  boundary "*" { u = {1, 0} }
  exact { c = function(x) return (exp(10 * x) - 1) / (exp(10) - 1) end }
  if streamline then term "species.streamline" {} end
elseif kind == "thiele" then -- reaction and diffusion in a slab, Thiele modulus 3
  box(false)
  term "species.reaction" { second_order = 0, max_rate = 0 }
  boundary "right" { c = 1 }
  exact { c = function(x) return (exp(3 * x) + exp(-3 * x)) / (exp(3) + exp(-3)) end }
elseif kind == "laws" then -- all laws at once in a stream, with the source that makes c what it is
  box(true)
  local function c(x) return 1 + 0.5 * math.sin(3 * x) end
  local function f(x)
    local v = c(x)
    return 1.5 * math.cos(3 * x) + 0.1 * 4.5 * math.sin(3 * x) + 0.9 * v + 2 * v * v + 3 * v / (0.5 + v)
  end
  term "species.reaction" { c_source = f }
  if streamline then term "species.streamline" { c_source = f } end
  boundary "left" { u = {1, 0}, c = c }
  boundary "right" { u = {1, 0}, c = c }
  boundary "*" { u = {1, 0} }
  exact { c = c }
elseif kind == "wall" then -- D c' is let in at the left, k c taken out at the right: a straight line
  mesh { box = {{0, 0}, {1, 0.5}}, cells = {n, 3}, shape = shape }
  fluid { diffusivity = 0.1 }
  term "species" { without = {"advection"} }
  boundary "left" { c_flux = 0.6 }
  boundary "right" { c_uptake = 0.2 }
  exact { c = function(x) return 3 + 6 * (1 - x) end }
elseif kind == "decay" then -- two species, each by a law of its own
  mesh { box = {{0, 0}, {1, 0.5}}, cells = {2, 1}, shape = shape }
  fluid { diffusivity = 0.1, diffusivity_2 = 0.2, first_order = 2, second_order_2 = 3 }
  term "species" { without = {"advection"} }
  term "species_2" { without = {"advection"} }
  term "species.reaction" {}
  term "species_2.reaction" {}
  initial { c = 2, c_2 = 4 }
  exact { c = function(x, y, t) return 2 * exp(-2 * t) end, c_2 = function(x, y, t) return 4 / (1 + 12 * t) end }
  time { step = dt, stop = 1 }
else -- "closed": bodies fill a closed box
  mesh { box = {{-1, -1}, {1, 1}}, cells = {12, 12}, shape = shape }
  fluid { diffusivity = 0.1 }
  term "species" { without = {"advection"} }
  term "species.body" { release = 0.7 }
  particle { shape = disk { radius = 0.31 }, density = 1, at = {0.013, 0.021}, motion = "fixed" }
  time { step = 0.1, stop = 0.4 }
  results(function(r)
    local area = 4 - math.pi * 0.31 ^ 2
    return { stored = r.mean.c[1] * area / (0.7 * 2 * math.pi * 0.31 * 0.4) }
  end)
end
if kind ~= "layer" and kind ~= "laws" then boundary "*" { natural = true } end
solve { tolerance = 1e-12 }
