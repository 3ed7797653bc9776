-- SPDX-License-Identifier: GPL-3.0-or-later
-- A body that moves and turns through a fluid, for the plugin memory: what was beside its surface, and in it, at the start is
-- still there (paths near a disk do not turn with it).  Marks are linear in place at the start; results: largest deviations, over what the disk has moved.
case "Marks that a disk carries along"

local n = param("n", 20, "cells in each direction")
local steps = param("steps", 8, "of time")
local shape = param("shape", "quads", "or triangles")
local kind = param("kind", "disk", "or ellipse")
local R, W, spin, T = 0.2, { 0.9, 0.4 }, 2, 0.2
local h, x0, y0 = 1 / n, -0.09, -0.04

local function mark(x, y) return 1 + 2 * x - y end

mesh  { box = {{-0.5, -0.5}, {0.5, 0.5}}, cells = {n, n}, shape = shape }
local law = param("law", false, "the viscosity comes from a memory that is 1/6 everywhere")
fluid { density = 1, viscosity = not law and 1 or nil }
term "continuity" {}
term "momentum" {}
particulate "sharp"
term "memory.mark" {}
if law then
  term "memory.structure" { builds = 0, breaks = 0, mu_s = 0 }
  term "memory.law" {}
end
term "memory.brand" {}
term "memory.odometer" {}
boundary "*" { u = {0, 0} }
initial { mark = mark, brand = mark, way = 5, structure = law and 1 / 6 or nil }
particle { shape = kind == "disk" and disk { radius = R } or ellipse { a = R, b = 0.8 * R }, density = 1, at = {x0, y0},
           motion = "prescribed", velocity = W, spin = spin }
time { scheme = "bdf1", step = T / steps, stop = T }

-- Where a point that moves along, and turns, is at the end.
local function at_end(a, r, turns)
  local b = a + (turns and spin * T or 0)
  return { x0 + W[1] * T + r * math.cos(b), y0 + W[2] * T + r * math.sin(b) }
end

local probes, exact = {}, {}
for k = 1, 16 do
  local a = 2 * math.pi * k / 16
  local s = kind == "disk" and 1 or 0.8 / math.sqrt((0.8 * math.cos(a)) ^ 2 + math.sin(a) ^ 2)
  local outside, inside = s * R + 0.2 * h, 0.8 * s * R
  probes["near" .. k], exact["near" .. k] = at_end(a, outside, kind ~= "disk"), mark(x0 + outside * math.cos(a), y0 + outside * math.sin(a))
  probes["in" .. k], exact["in" .. k] = at_end(a, inside, true), mark(x0 + inside * math.cos(a), y0 + inside * math.sin(a))
end
output { probes = probes }

results(function(r)
  local way, near, inside = T * math.sqrt(W[1] ^ 2 + W[2] ^ 2), 0, 0
  for k = 1, 16 do
    near = math.max(near, math.abs(r.last["near" .. k .. ".mark"] - exact["near" .. k]))
    inside = math.max(inside, math.abs(r.last["in" .. k .. ".brand"] - exact["in" .. k]))
  end
  return { near = near / way / math.sqrt(5), inside = inside / way / math.sqrt(5) }
end)
