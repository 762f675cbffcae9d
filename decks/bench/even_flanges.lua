-- even_flanges.lua -- ../bolted_flanges.lua with cells of one size: what the speed and the error figures of the manual are made with.
--
-- Run        dygita run decks/bench/even_flanges.lua                --set size=2*mm
-- Expect     at size = 4 mm (6618 unknowns) a bolt force of 30.65 kN, 4.7 % more than the limit of ever finer meshes: cells of one size converge
--            slowly at the edges of head, hole and rod (30.55 kN at 3 mm, 30.61 at 2.5 mm), cells graded to them do not. The spectrum above the
--            joint is that of the graded mesh within 0.1 dB
-- Read next  ../bolted_flanges.lua

local p = param{ mu = 0.2, yield = 640*MPa, hardening = 50*MPa/mm, tighten = 0.06*mm, size = 4*mm, dt = 1*us, duration = 200*us }

-- What does not change from one case to the next -------------------------------------

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }

local flanges = mesh.gmsh{ file = "../../meshes/bolted_flanges.geo", set = { size = p.size, graded = 0 } }
local function part(name)
  return substructure{ name = name, mesh = flanges:volume(name), material = steel }
end
local lower, upper, rod, head, nut = part "lower", part "upper", part "rod", part "head", part "nut"

local thread = interface.bonded{ name = "thread", between = { rod:face "nut_end", nut:face "rod_end" } }
local seat   = interface.bonded{ name = "seat", between = { nut:face "lower", lower:face "nut" } }
local shank  = interface.plastic{
  name = "shank", between = { rod:face "head_end", head:face "rod_end" },
  yield = p.yield, hardening = p.hardening,
}

local base = support.fixed{ name = "base", on = lower:face "base" }

local tighten = step.static{
  name = "tighten", increments = 2,
  loads = { load.shortening{ on = shank, by = p.tighten } },
}
local shock = step.dynamic{
  name = "shock", after = tighten, duration = p.duration, dt = p.dt,
  loads = {
    load.traction{ on = upper:face "top", z = history.half_sine{ peak = 100*MPa, duration = 40*us } },
  },
}

-- What is asked for -------------------------------------------------------------------

local a_in  = output.history{ name = "above", on = upper:face "top",  quantity = "acceleration", direction = { 0, 0, 1 } }
local a_out = output.history{ name = "below", on = lower:face "side", quantity = "acceleration", direction = { 0, 0, 1 } }
local srs_in  = output.srs{ name = "srs_above", of = a_in,  q_factor = 10, from = 1*kHz, to = 100*kHz }
local srs_out = output.srs{ name = "srs_below", of = a_out, q_factor = 10, from = 1*kHz, to = 100*kHz }
local bolt    = output.joint{ name = "bolt", on = shank }

-- One case ------------------------------------------------------------------------------

local function bolted(mu)
  local mating = interface.contact{ name = "mating", between = { lower:face "upper", upper:face "lower" }, friction = mu }
  local under  = interface.contact{ name = "under_head", between = { upper:face "head", head:face "upper" }, friction = mu }
  return problem{
    name          = "bolted_flanges",
    substructures = { lower, upper, rod, head, nut },
    interfaces    = { mating, under, thread, seat, shank },
    supports      = { base },
    steps         = { tighten, shock },
    outputs       = {
      a_in, a_out, srs_in, srs_out, bolt, output.joint{ name = "joint", on = mating }, output.energy{},
      output.vtk{ frames = 50, fields = { "displacement", "velocity", "stress", "von_mises" } },
    },
  }
end

local result = bolted(p.mu):run{}
print(("bolt force %.2f kN tightened, %.2f kN at the end; yielded by %.2f um; %d iterations"):format(
  result[bolt].normal:at(tighten) / kN, result[bolt].normal.last / kN,
  result[bolt].plastic_opening.max / um, result.iterations))
