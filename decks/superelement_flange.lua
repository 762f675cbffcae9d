-- superelement_flange.lua -- a far part as a superelement: the lower flange, condensed once, stands for its mesh in the shock.
--
--           ^ ^ ^ pull, haversine
--      +----------------+
--      |     upper      |   a mesh: what is near the joint and what is looked at
--      +-----+    +-----+   contact with friction at all nodes of both faces, bolt tightened to 29.6 kN
--      :     lower      :   matrices: three rows a node of its faces `upper`, `nut` and `side`, and modes up to twice `up_to`;
--      +----------------+   its fixed base was condensed with it
--
-- Run        dygita run decks/superelement_flange.lua --set lower=1      condenses it: out/lower_flange/base/lower.json and its matrices
--            dygita run decks/superelement_flange.lua --set lower=2      the shock with the superelement
--            dygita run decks/superelement_flange.lua                    the same with the mesh
-- Expect     the same numbers from both: 29.745 kN tightened, 29.60 kN at the end, a spectrum above the joint of up to 2586 g. The faces
--            here are as large as the flange, so that nothing is won: 1296 rows and 410 modes instead of 4608 unknowns. A superelement
--            pays where much lies behind a small face
-- Read next  condensed_flanges.lua (rows for a system model: six motions of each face, and how Python reads them)

local p = param{ lower = 0, size = 6*mm, up_to = 150*kHz, dt = 1*us, duration = 200*us }

local size, up_to, dt, duration = p.size, p.up_to, p.dt, p.duration

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = 2e-8 }
local flanges = mesh.gmsh{ file = "../meshes/bolted_flanges.geo", set = { size = size } }
local function part(name) return substructure{ name = name, mesh = flanges:volume(name), material = steel } end

if p.lower == 1 then
  local lower = part "lower"
  local element = output.superelement{ name = "lower", on = { lower:face "upper", lower:face "nut", lower:face "side" }, motion = "nodes", up_to = up_to }
  problem{
    name = "lower_flange", substructures = { lower }, supports = { support.fixed{ name = "base", on = lower:face "base" } },
    steps = { step.static{ name = "rest", increments = 1 } }, outputs = { element },
  }:run{}
  return
end

local lower
if p.lower == 2 then
  lower = substructure.superelement{ name = "lower", file = "../out/lower_flange/base/lower.json" }
else
  lower = part "lower"
end
local upper, rod, head, nut = part "upper", part "rod", part "head", part "nut"

local thread = interface.bonded{ name = "thread", between = { rod:face "nut_end", nut:face "rod_end" } }
local seat   = interface.bonded{ name = "seat", between = { nut:face "lower", lower:face "nut" } }
local shank  = interface.plastic{ name = "shank", between = { rod:face "head_end", head:face "rod_end" }, yield = 640*MPa, hardening = 50*MPa/mm }
local mating = interface.contact{ name = "mating", between = { lower:face "upper", upper:face "lower" }, friction = 0.2 }
local under  = interface.contact{ name = "under_head", between = { upper:face "head", head:face "upper" }, friction = 0.2 }
local supports = {}
if p.lower == 0 then supports[1] = support.fixed{ name = "base", on = lower:face "base" } end

local tighten = step.static{ name = "tighten", increments = 2, loads = { load.shortening{ on = shank, by = 0.06*mm } } }
local shock = step.dynamic{
  name = "shock", after = tighten, duration = duration, dt = dt,
  loads = { load.traction{ on = upper:face "top", z = history.haversine{ peak = 3*MPa, duration = 100*us } } },
}

local above = output.history{ name = "above", on = upper:face "top", quantity = "acceleration", direction = { 0, 0, 1 } }
local spectrum = output.srs{ name = "srs_above", of = above, q_factor = 10, from = 5*kHz, to = 60*kHz }
local bolt = output.joint{ name = "bolt", on = shank }
local result = problem{
  name = p.lower == 2 and "on_superelement" or "on_mesh", substructures = { lower, upper, rod, head, nut },
  interfaces = { mating, under, thread, seat, shank }, supports = supports, steps = { tighten, shock },
  solver = solver.latin{ integration = "implicit" },  -- a superelement always is: so is the mesh that it is compared with
  outputs = { above, spectrum, bolt, output.joint{ name = "joint", on = mating }, output.energy{}, output.vtk{ frames = 20 } },
}:run{}

print(("bolt force %.3f kN tightened, %.3f kN at the end; spectrum above the joint up to %.1f g; %.1f iterations per step"):format(
  result[bolt].normal:at(tighten) / kN, result[bolt].normal.last / kN, result[spectrum].maximax.max / g0, result.mean_iterations))
