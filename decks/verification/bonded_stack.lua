-- bonded_stack.lua -- a pad glued between two steel blocks, no two faces of a like mesh: what the iteration costs.
--
--         +-------+  -> pushed             young, thickness of the pad: from rubber to steel;
--         | steel |                        lower, middle, upper: facets of the three meshes;
--       +-+-------+-+                      dt: waves cross the steel several times in 20 us
--       |    pad    |
--      ++-----------++
--      |    steel    |
--      +-------------+
--      ///////////////
--
-- Run        dygita run decks/verification/bonded_stack.lua --set young=0.5*GPa --set lower=3*mm --set middle=6*mm --set upper=3*mm
--            python3 manual/verification/iterations.py build/dygita        prints the table of the manual

local p = param{ young = 20*GPa, lower = 8*mm, middle = 3.7*mm, upper = 5*mm, dt = 20*us }

local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local glued = material.elastic{ name = "pad", young = p.young, poisson = 0.4, density = 1300 }

local function stacked(name, material, width, bottom, top, facet, layers)
  local n = math.floor(width/facet + 0.5)
  local at = (60*mm - width)/2 + 1*mm
  return substructure{ name = name, material = material,
    mesh = mesh.box{ origin = { at, at, bottom }, size = { width, width, top - bottom }, cells = { n, n, layers } } }
end
local lower = stacked("lower", steel, 60*mm, 0, 20*mm, p.lower, 4)
local pad = stacked("pad", glued, 50*mm, 20*mm, 24*mm, p.middle, 2)
local upper = stacked("upper", steel, 44*mm, 24*mm, 44*mm, p.upper, 4)

local press = load.pressure{ on = upper:face "zmax", history = 1*MPa }
local static = step.static{ name = "press", loads = { press } }
local shock = step.dynamic{ name = "shock", after = static, duration = 1*ms, dt = p.dt,
  loads = { press, load.traction{ on = upper:face "xmax", x = history.half_sine{ peak = 0.3*MPa, duration = 0.3*ms } } } }

problem{ name = "bonded_stack", substructures = { lower, pad, upper },
  interfaces = { interface.bonded{ between = "all touching" } },
  supports = { support.fixed{ name = "floor", on = lower:face "zmin" } },
  steps = { static, shock }, outputs = { output.energy{} } }:run{}
