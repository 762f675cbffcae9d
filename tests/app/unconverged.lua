-- Two blocks and a bolt, with every output that makes a file: tightened, pushed to and fro, struck.
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, yield = 900*MPa }
local function block(name, from, size, cells)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = from, size = size, cells = cells } }
end
local foot = block("foot", { 0, 0, 0 }, { 40*mm, 20*mm, 10*mm }, { 8, 4, 2 })
local slab = block("slab", { 0, 0, 10*mm }, { 25*mm, 20*mm, 10*mm }, { 5, 4, 2 })
local rod  = block("rod", { 30*mm, 5*mm, 10*mm }, { 5*mm, 10*mm, 10*mm }, { 1, 2, 2 })
local head = block("head", { 20*mm, 5*mm, 20*mm }, { 15*mm, 10*mm, 5*mm }, { 3, 2, 1 })

local shank  = interface.plastic{ name = "shank", between = { rod:face "zmax", head:face "zmin" }, yield = 600*MPa, hardening = 50*MPa/mm }
local thread = interface.bonded{ name = "thread", between = { foot:face "zmax", rod:face "zmin" } }
local under  = interface.contact{ name = "under", between = { foot:face "zmax", slab:face "zmin" }, friction = 0.2 }
local seat   = interface.contact{ name = "seat", between = { slab:face "zmax", head:face "zmin" }, friction = 0.2 }
local floor  = support.fixed{ name = "floor", on = foot:face "zmin" }

local function push(name, after, by)
  return step.static{ name = name, after = after, increments = 3, loads = { load.traction{ on = slab:face "xmin", x = by } } }
end
local tighten = step.static{ name = "tighten", increments = 2, loads = { load.preload{ on = shank, force = 8*kN } } }
local there = push("there", tighten, 4*MPa)
local back  = push("back", there, -4*MPa)
local again = push("again", back, 4*MPa)
local strike = step.dynamic{ name = "strike", after = again, duration = 40*us, dt = 1*us, loads = {
  load.traction{ on = slab:face "xmin", x = 4*MPa },
  load.pressure{ on = head:face "zmax", history = history.half_sine{ peak = 60*MPa, duration = 20*us } } } }

local x, z = { 1, 0, 0 }, { 0, 0, 1 }
local below = output.history{ name = "below", on = foot:face "zmax", quantity = "acceleration", direction = z }
local above = output.history{ name = "above", on = head:face "zmax", quantity = "acceleration", direction = z }
local moved = output.history{ name = "moved", on = slab:face "xmax", quantity = "displacement" }
local srs   = output.srs{ name = "srs", of = above, from = 25*kHz, to = 200*kHz, specification = { { 10*kHz, 1e7 }, { 300*kHz, 1e7 } } }
local result = problem{
  name = "unconverged", substructures = { foot, slab, rod, head }, interfaces = { shank, thread, under, seat }, supports = { floor },
  steps = { tighten, there, back, again, strike },
  outputs = { below, above, moved, srs, output.attenuation{ name = "through", entering = below, leaving = above, from = 25*kHz, to = 200*kHz },
    output.srs_field{ name = "field", on = slab:face "zmax", direction = z, from = 25*kHz, to = 200*kHz, per_octave = 2 },
    output.joint{ name = "joint", on = under }, output.footprint{ name = "footprint", on = under }, output.resultant{ name = "force", on = under },
    output.momentum{ name = "momentum", of = slab },
    output.loop{ name = "loop", on = under, direction = x, after = tighten, steps = { there, back, again } },
    output.superelement{ name = "element", on = { head:face "zmax" }, modes = 2, after = tighten, sliding = "tied" },
    output.energy{}, output.vtk{ frames = 5, fields = { "von_mises" } } },
}:run{}
print(("rows of 'moved' that have not converged: %d; spectrum: %d"):format(
  (function() local n = 0 for i = 1, #result[moved].converged do n = n + 1 - result[moved].converged[i] end return n end)(),
  #result[srs].maximax - result[srs].converged[1] * #result[srs].maximax))
