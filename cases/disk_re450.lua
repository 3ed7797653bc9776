-- A disk that falls fast: density 1.5 in a fluid ten times thinner than in falling_disk (Glowinski et al. 2001, J. Comput. Phys.
-- 169:363). Published largest Reynolds numbers rho_P d |U| / mu lie between 438 and 466 and grow as the mesh gets finer (Glowinski et
-- al.; Wan and Turek 2006, Int. J. Numer. Meth. Fluids 51:531). The disk falls straight at first and at 0.14 s has 458 to 467. Then its
-- wake tips over, it drifts to a side, slows down, and rebounds from the floor. When the wake tips over is a matter of small
-- disturbances, and with it the largest Reynolds number: 527, 526, 523 at four, six, eight cells across, 502 at four without `stabilise`.
-- Two minutes.
case "Disk falling fast"

local n = param("n", 16, "cells per cm")
local tolerance = param("tolerance", 1e-2, "of steps that choose their length")
local dt = param("dt", 0, "length of all steps instead, s")
local stop = param("stop", 0.4, "end, s")
local stabilise = param("stabilise", true, "terms against convection that the mesh does not resolve")
local formulation = param("formulation", "sharp", "sharp or conservative")
local d, rho, mu = 0.25, 1.5, 0.01

mesh  { box = {{0, 0}, {2, 6}}, cells = {2 * n, 6 * n} }
fluid { density = 1, viscosity = mu, gravity = {0, -981} }

term "continuity" {}
term "momentum" {}
particulate(formulation)
term "contact.repulsion" { range = 0.06, strength = 40 } -- stiff: what falls fast stays clear of the floor by half a cell
term "contact.lubrication" {}                      -- films thinner than cells
if stabilise then term "stabilise" {} end

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = d / 2 }, density = rho, at = {1, 4} }

if dt > 0 then time { step = dt, stop = stop } else time { tolerance = tolerance, stop = stop } end
output { every = stop / 20 }

results(function(r)
  local v, most, when, early = r.series["p0.v"], 0, 0, 0
  for i = 1, #v do
    if r.t[i] <= 0.14 + 1e-9 then early = rho * d * math.abs(v[i]) / mu end -- the wake is symmetric up to there
    if math.abs(v[i]) > most then most, when = math.abs(v[i]), r.t[i] end
  end
  return { re_early = early, re_max = rho * d * most / mu, at = when, x = r.last["p0.x"], y = r.last["p0.y"] }
end)
