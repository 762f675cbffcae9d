-- pin_in_hole.lua -- a loose pin pulled against the rim of its hole: how far around it touches, and how hard (Persson).
--
--          plate                        the half y > 0, in plane stress: both thin; the plate is held at 30 radii
--            .-----.
--          .'       `.
--         /   pin     \                 E dR / P, the looseness, says it all: dR the clearance, P the pull a length
--        |     o---> P | e              pressed over the angle e on either side
--
-- Run        dygita run decks/verification/pin_in_hole.lua           --set looseness=0.1   --set ratio=0.7
-- See        out/pin_in_hole/base/interfaces.pvd                     colour by pressure
-- Expect     half angle of contact and peak pressure within 0.5 % of Persson's (half planes of one material, without friction)
-- Read next  press_fit_rings.lua
-- Mesh       meshes/pin_in_hole.geo: volumes pin and plate, n and ratio n cells a quarter of them

local p = param{ n = 20, ratio = 1.3, looseness = 1, core = 0.15, order = 1 }

local E, nu = 210*GPa, 0.3
local steel = material.elastic{ name = "steel", young = E, poisson = nu, density = 7800 }
local R, thick, clearance = 10*mm, 0.25*mm, 10*um
local function body(i, name, n)
  local file = mesh.gmsh{ file = "../../meshes/pin_in_hole.geo", order = p.order, set = { body = i, n = n, radius = R, rim = 30 * R, thick = thick } }
  return substructure{ name = name, mesh = file:volume(name), material = steel }
end
local pin, plate = body(1, "pin", math.floor(p.ratio * p.n + 0.5)), body(2, "plate", p.n)
local contact = interface.contact{ name = "contact", between = { pin:face "round", plate:face "hole" }, gap = clearance }
local supports = {
  support.symmetry{ name = "middle", on = { pin:face "y", plate:face "y" } },
  support.symmetry{ name = "lower", on = { pin:face "lower", plate:face "lower" } },
  support.fixed{ name = "rim", on = plate:face "rim" },
}

local P = E * clearance / p.looseness                 -- N/m, of both halves
local core = pin:where(function(x, y, z) return x^2 + y^2 < (p.core * R)^2 end)
local press = step.static{ name = "press", loads = { load.force{ on = core, x = P * thick / 2 } } }
local footprint = output.footprint{ name = "footprint", on = contact, about = { 0, 0, 0 } }
local result = problem{
  name = "pin_in_hole", substructures = { pin, plate }, interfaces = { contact }, supports = supports, steps = { press },
  outputs = { footprint, output.joint{ name = "joint", on = contact }, output.vtk{ frames = 1 } },
}:run{}

-- Persson: p R/P at the angle phi, the looseness E dR/P, for the half angle e of contact; integrals by the midpoint rule in
-- y = b sin(s), where the root at the end of contact is smooth.
local function log_term(b, y)
  local root = math.sqrt(b^2 - y^2)
  return math.log((math.sqrt(b^2 + 1) + root) / (math.sqrt(b^2 + 1) - root))
end
local function pressure(b, y)
  return 2 * math.sqrt(b^2 - y^2) / (math.pi * math.sqrt(1 + b^2) * (1 + y^2)) + log_term(b, y) / (2 * math.pi * b^2 * (1 + b^2))
end
local function integral(b, f)
  local n, sum = 400, 0
  for i = 1, n do
    local s = math.pi * ((i - 0.5) / n - 0.5)
    local y = b * math.sin(s)
    sum = sum + f(y) * b * math.cos(s) * math.pi / n
  end
  return sum
end
local function looseness(b)
  local I = integral(b, function(t) return log_term(b, t) / (1 + t^2) end)
  return 2 * (1 - b^2) / (math.pi * b^2) - I / (math.pi^2 * b^2 * (1 + b^2))
end
-- Mean of sin^2 over the forces: sin(phi) = 2 y/(1 + y^2), dphi = 2 dy/(1 + y^2).
local function width(b)
  local function of(f) return integral(b, function(y) return pressure(b, y) * f(2 * y / (1 + y^2)) * 2 / (1 + y^2) end) end
  return of(function(s) return s^2 end) / of(function() return 1 end)
end
local function solve(f, value, low, high)             -- f falls or rises from low to high
  local rises = f(high) > f(low)
  for _ = 1, 60 do
    local middle_ = (low + high) / 2
    if (f(middle_) < value) == rises then low = middle_ else high = middle_ end
  end
  return low
end
local b = solve(looseness, p.looseness, 0.01, 0.99)
local at = result[footprint]
local got = solve(width, (at.spread_y.last / R)^2, 0.01, 0.99)
local angle, exact = 2 * math.atan(got), 2 * math.atan(b)
local sum = integral(b, function(y) return pressure(b, y) * (1 - y^2) / (1 + y^2) * 2 / (1 + y^2) end)
print(("half angle of contact, error of Persson's: %+.3f %% (%.3f of %.3f deg)"):format(100 * (angle / exact - 1), angle / deg, exact / deg))
print(("peak pressure, error of Persson's: %+.3f %% (%.5f of %.5f P/R)"):format(100 * (at.pressure.last * R / P / pressure(b, 0) - 1), at.pressure.last * R / P, pressure(b, 0)))
print(("iterations in all: %d; Persson's pressures pull with: %.6f P"):format(result.iterations, sum))
