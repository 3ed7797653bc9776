-- A charged disk between two walls, driven by a uniform field: the velocity at which drag and field balance.
-- Expect drag = 1 within 1 %: q E over Faxen's drag of a cylinder midway between walls, 4 pi mu U / (ln(1/k) - 0.9157 + ...),
-- k = R / half the width (O. H. Faxen 1946, Proc. R. Swed. Acad. Eng. Sci. 187; Happel and Brenner 1983, (7-6.29)).
case "A charged disk between walls"

local n = param("n", 16, "cells across")
local k = param("k", 0.25, "radius over half the width")
local charge = param("charge", 3, "of the disk, C/m")
local field = param("field", 0.5, "N/C")

mesh  { box = {{0, 0}, {6, 1}}, cells = {6 * n, n} }
fluid { density = 1e-6, viscosity = 1 }

term "continuity" {}
term "momentum" {}
particulate "sharp"
term "electro.force" { field = {field, 0} }

boundary "*" { u = {0, 0} }

particle { shape = disk { radius = k / 2 }, density = 1, at = {3, 0.5}, charge = charge }

results(function(r)
  local faxen = 4 * math.pi / (math.log(1 / k) - 0.9157 + 1.7244 * k^2 - 1.7302 * k^4 + 2.4056 * k^6 - 4.5913 * k^8)
  return { u = r.last["p0.u"], drag = charge * field / (faxen * r.last["p0.u"]), balance = r.last["p0.fx"] + charge * field }
end)
