-- sector_ensemble.lua -- a sector of the separation ring as n units, each with its own preload, friction and charge.
--
-- Run   ./run.sh bench ensembles            dygita run decks/bench/sector_ensemble.lua --set n=8    --set alone=1 (one unit)
--
-- One bolt of decks/separation_ring.lua between planes of symmetry; implicit, static and dynamic.

local p = param{ n = 16, alone = 0, bolts = 24, size = 6*mm, duration = 0.3*ms, dt = 2*us }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local alloy = material.elastic{ name = "alloy", young = 72*GPa, poisson = 0.33, density = 2800 }
local function body(i, name, material_)
  local file = mesh.gmsh{ file = "../../meshes/separation_ring.geo", set = { body = i, size = p.size, bolts = p.bolts } }
  return substructure{ name = name, mesh = file:volume(name), material = material_ }
end
local upper, lower, stud, head = body(1, "upper", alloy), body(2, "lower", alloy), body(3, "stud", steel), body(4, "head", steel)

local nut   = interface.bonded{ name = "nut", between = { stud:face "seat", lower:face "seat" } }
local shank = interface.bonded{ name = "bolt", between = { stud:face "head_end", head:face "stud_end" } }
local supports = {
  support.absorbing{ name = "ends", on = { upper:face "end", lower:face "end" } },
  support.symmetry{ name = "cuts", on = { upper:face "left", upper:face "right", lower:face "left", lower:face "right" } },
}
local function spectrum(name, part, low, high)
  local shell = part:where(function(x, y, z) return z > low and z < high and math.abs(y) < 15*mm and x > 497*mm end)
  local a = output.history{ name = name, on = shell, quantity = "acceleration", direction = { 0, 0, 1 } }
  return a, output.srs{ name = "srs " .. name, of = a, from = 2*kHz, to = 20*kHz }
end
local above, srs_above = spectrum("above", upper, 18*mm, 32*mm)
local below, srs_below = spectrum("below", lower, -32*mm, -18*mm)
local joint = output.joint{ name = "joint", on = shank }

local function unit(v)
  local tighten = step.static{ name = "tighten", loads = { load.preload{ on = shank, force = v.preload } } }
  local shock = step.dynamic{ name = "shock", after = tighten, duration = p.duration, dt = p.dt,
    loads = { load.pressure{ on = upper:face "band", history = history.half_sine{ peak = v.peak, duration = 20*us } } } }
  return problem{
    name = "sector", substructures = { upper, lower, stud, head }, supports = supports, steps = { tighten, shock },
    interfaces = {
      interface.contact{ name = "mating", between = { lower:face "mating", upper:face "mating" }, friction = v.mu },
      interface.contact{ name = "under head", between = { upper:face "seat", head:face "seat" }, friction = v.mu },
      nut, shank,
    },
    outputs = { above, below, srs_above, srs_below, joint },
    solver = solver.latin{ integration = "implicit" },
  }
end

if p.alone == 1 then
  unit{ preload = 20*kN, mu = 0.2, peak = 10*MPa }:run{}
else
  ensemble{ n = p.n, of = unit,
    vary = { preload = uniform(0.7, 1.3)*20*kN, mu = triangular(0.1, 0.2, 0.3), peak = normal(10, 1)*MPa } }:run{}
end
