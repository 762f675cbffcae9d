-- flanges_ensemble.lua -- the bolted flanges as sixteen units: what scatter of preload, friction and shock does to the spectrum.
--
--           > > > push, half-sine                 head
--      +----------------+                        +------+
--      |     upper      |   contact, friction    | rod  |   each unit with its own preload, friction and peak
--      +-----+    +-----+                        |      |
--      |     lower      |                        |      |
--      +----------------+                        +------+
--        fixed base                                nut
--
-- Run        dygita run decks/flanges_ensemble.lua                --set n=8    --set alone=1 (the median unit, with its report)
-- See        out/flanges/ensemble/srs_below.svg            median, P95/50, envelope and specification
--            out/flanges/ensemble/ensemble_drives.csv      which parameter drives which output
--            out/flanges/ensemble/ensemble_members.csv     the units one by one
-- Read next  manual/howto/ensembles.md
--
-- Mesh       meshes/bolted_flanges.geo, as decks/bolted_flanges.lua has it

local p = param{ n = 16, seed = 1, alone = 0, size = 5*mm, dt = 1*us, duration = 200*us, damping = 0.3*us }

-- What all units share ---------------------------------------------------------------

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = p.damping }
local mesh_of_all = mesh.gmsh{ file = "../meshes/bolted_flanges.geo", set = { size = p.size } }
local function part(name) return substructure{ name = name, mesh = mesh_of_all:volume(name), material = steel } end
local lower, upper, rod, head, nut = part "lower", part "upper", part "rod", part "head", part "nut"

local thread = interface.bonded{ name = "thread", between = { rod:face "nut_end", nut:face "rod_end" } }
local seat   = interface.bonded{ name = "seat", between = { nut:face "lower", lower:face "nut" } }
local shank  = interface.plastic{ name = "shank", between = { rod:face "head_end", head:face "rod_end" }, yield = 640*MPa, hardening = 50*MPa/mm }
local base   = support.fixed{ name = "base", on = lower:face "base" }

local function spectrum(name, face, levels)
  local a = output.history{ name = name, on = face, quantity = "acceleration", direction = { 1, 0, 0 } }
  return a, output.srs{ name = "srs_" .. name, of = a, q_factor = 10, from = 5*kHz, to = 40*kHz,
    specification = levels }
end
local a_above, srs_above = spectrum("above", upper:face "top", { { 5*kHz, 30000*g0 }, { 40*kHz, 30000*g0 } })
local a_below, srs_below = spectrum("below", lower:face "side", { { 5*kHz, 150*g0 }, { 20*kHz, 1600*g0 }, { 40*kHz, 10000*g0 } })
local bolt = output.joint{ name = "bolt", on = shank }

-- One unit: what scatters is v ---------------------------------------------------------

local function unit(v)
  local tighten = step.static{ name = "tighten", increments = 2, loads = { load.preload{ on = shank, force = v.preload } } }
  local shock = step.dynamic{ name = "shock", after = tighten, duration = p.duration, dt = p.dt,
    loads = { load.traction{ on = upper:face "top", x = history.half_sine{ peak = v.peak, duration = 40*us } } } }
  return problem{
    name = "flanges", substructures = { lower, upper, rod, head, nut }, supports = { base }, steps = { tighten, shock },
    interfaces = {
      interface.contact{ name = "mating", between = { lower:face "upper", upper:face "lower" }, friction = v.mu },
      interface.contact{ name = "under_head", between = { upper:face "head", head:face "upper" }, friction = v.mu },
      thread, seat, shank,
    },
    outputs = { a_above, a_below, srs_above, srs_below, bolt },
  }
end

if p.alone == 1 then
  unit{ preload = 30*kN, mu = 0.18, peak = 20*MPa }:run{ case = "median" }
  return
end

-- Torque scatters preload by 30 %, friction is known to a factor, the shock to 10 %.
local r = ensemble{
  n = p.n, seed = p.seed, of = unit,
  vary = { preload = uniform(0.7, 1.3)*30*kN, mu = triangular(0.1, 0.15, 0.3), peak = normal(20, 2)*MPa },
}:run{}

print(("spectrum below the joint at 10 kHz: median %.0f g, P95/50 %.0f g"):format(r[srs_below].median:at(10*kHz) / g0, r[srs_below].p95_50:at(10*kHz) / g0))
print(("bolt force at the end: median %.1f kN, one in twenty below %.1f kN"):format(r[bolt].normal.last.median / kN, r[bolt].normal.last:quantile(0.05) / kN))
print(r.drives[bolt])
