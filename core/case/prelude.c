/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What every case finds defined, written in Lua. */
#include "case/case.h"

const char *const case_prelude =
    /* pairs in a fixed order: numbers first, then strings */
    "local next, type, sort = next, type, table.sort\n"
    "function pairs(t)\n"
    "  local keys = {}\n"
    "  for k in next, t do keys[#keys + 1] = k end\n"
    "  sort(keys, function(a, b)\n"
    "    if type(a) == type(b) and (type(a) == 'number' or type(a) == 'string') then return a < b end\n"
    "    return type(a) == 'number' and type(b) ~= 'number'\n"
    "  end)\n"
    "  local i = 0\n"
    "  return function() i = i + 1; if keys[i] ~= nil then return keys[i], t[keys[i]] end end\n"
    "end\n"
    /* grid{0, 10, 0.5, 20, 2}: 10 equal cells from 0 to 0.5, 20 from 0.5 to 2 */
    "function grid(list)\n"
    "  local ticks = {list[1]}\n"
    "  for i = 1, #list - 2, 2 do\n"
    "    local a, n, b = list[i], list[i + 1], list[i + 2]\n"
    "    for k = 1, n do ticks[#ticks + 1] = a + (b - a) * k / n end\n"
    "  end\n"
    "  return ticks\n"
    "end\n"
    /* graded(a, b, n, r): n cells from a to b, each r times as long as the one before */
    "function graded(a, b, n, r)\n"
    "  local ticks, x, h = {a}, 0, 1\n"
    "  for k = 1, n do x = x + h; ticks[k + 1] = x; h = h * r end\n"
    "  for k = 2, n + 1 do ticks[k] = a + (b - a) * ticks[k] / x end\n"
    "  return ticks\n"
    "end\n"
    /* clustered(a, b, n, s): n cells from a to b, finer at both ends; s > 0 says how much */
    "function clustered(a, b, n, s)\n"
    "  local ticks = {}\n"
    "  local function tanh(z) local e = math.exp(2 * z); return (e - 1) / (e + 1) end\n"
    "  for k = 0, n do ticks[k + 1] = a + (b - a) * 0.5 * (1 + tanh(s * (2 * k / n - 1)) / tanh(s)) end\n"
    "  return ticks\n"
    "end\n";
