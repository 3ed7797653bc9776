-- SPDX-License-Identifier: GPL-3.0-or-later
-- Uniform shear, for the plugin memory: u = (G(t) y, 0), whatever the viscosity is.
case "Uniform shear"

local what = param("what", "strain", "strain, structure or peak")
local shape = param("shape", "quads", "or triangles")
local step = param("step", 0.1, "of time")
local longest = param("longest", 1e300, "step that the term takes")
local adaptive = param("adaptive", false, "steps choose their length")
local G = param("G", 2, "rate of shear")
local swings = param("swings", false, "it is G sin(3 t)")
local three = param("three", false, "in 3D")

local function rate(t) return swings and G * math.sin(3 * t) or G end

mesh  { box = three and {{0, 0, 0}, {1, 1, 1}} or {{0, 0}, {1, 1}}, cells = three and {2, 2, 2} or {3, 2}, shape = shape }
fluid { density = 1, viscosity = what ~= "law" and 0.5 or nil }
term "continuity" {}
term "momentum" { without = { "inertia", "convection" } }
if what == "strain" then
  term "memory.strain" { longest = longest }
elseif what == "law" then
  term "memory.structure" { builds = 0.7, breaks = 0.4, mu_s = 0 }
  term "memory.law" {}
elseif what == "structure" then
  term "memory.structure" { builds = 0.7, breaks = 0.4, mu_s = 3 }
else
  term "memory.peak" {}
end

local shear = three and function(x, y, z, t) return rate(t) * y, 0, 0 end or function(x, y, t) return rate(t) * y, 0 end
boundary { periodic = { "left", "right" } }
boundary "*" { u = shear }
initial { u = shear, [what == "law" and "structure" or what] = (what == "structure" or what == "law") and 1 or 0 }
if adaptive then time { tolerance = 1e-3, stop = 1 } else time { step = step, stop = 1, scheme = "bdf1" } end
output { probes = { here = three and {0.3, 0.4, 0.6} or {0.3, 0.4} }, forces = { "top" } }
