-- SPDX-License-Identifier: GPL-3.0-or-later
-- Means of x^2 over the cells of a box, for the plugin cells.
case "Means of cells"

local shape = param("shape", "quads", "of the cells")
local curved = param("curved", false, "cells that are no boxes")
local decay = param("decay", 0, "time of decay; above 0 the case is unsteady")
local threads = shape == "tets" or shape == "hexes"

local function bend(x, y, z) return x + 0.05 * math.sin(3 * y) * x * (1 - x), y, z end

mesh { box = threads and {{0, 0, 0}, {1, 1, 1}} or {{0, 0}, {1, 1}}, cells = threads and {4, 2, 2} or {4, 3}, shape = shape,
       map = curved and bend or nil }
term "cells" { f = decay > 0 and 0 or function(x) return x * x end, a = decay }
term "cells.flows" {}
boundary "*" { natural = true }
initial { mean = function(x) return x end }
if decay > 0 then time { step = 0.1, stop = 0.5, scheme = "bdf1" } end
output { probes = { here = threads and {0.3, 0.4, 0.3} or {0.3, 0.4} } }
