-- u = (y^2, x^2) g(t), p = (x + y) g(t): in the spaces at every time, so that all error is of the time scheme.
case "Manufactured solution in time"

local dt = param("dt", 0.1, "time step")
local stop = param("stop", 1, "end")
local scheme = param("scheme", "bdf2", "bdf1 or bdf2")
local mu, rho = 0.5, 1.1

local function g(t) return 1 + math.sin(3 * t) end
local function dg(t) return 3 * math.cos(3 * t) end
local function velocity(x, y, t) return y * y * g(t), x * x * g(t) end
local function pressure(x, y, t) return (x + y) * g(t) end
local function force(x, y, t)
  local u, v = velocity(x, y, t)
  return rho * (y * y * dg(t) + v * 2 * y * g(t)) - 2 * mu * g(t) + g(t),
         rho * (x * x * dg(t) + u * 2 * x * g(t)) - 2 * mu * g(t) + g(t)
end

mesh { box = {{0, 0}, {1, 1}}, cells = {3, 3} }
fluid { density = rho, viscosity = mu }
term "continuity" {}
term "momentum" { force = force }
boundary "*" { u = velocity }
initial { u = velocity, p = pressure }
exact { u = velocity, p = pressure }
time { scheme = scheme, step = dt, stop = stop }
solve { tolerance = 1e-13 }
