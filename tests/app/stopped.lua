-- A stack that is tightened to a force and struck, small enough to be stopped a hundred times: a clamp of three tied
-- blocks, a block under it by friction, a bolt beside it that yields. The clamp tilts until it stands on its edge: no joint
-- to build, but one whose preload has to be searched for.
local p = param{ window = 1, explicit = 0, passes = 0, preload = 1, us = 60, broken = 0, tolerance = 1e-6 }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local soft  = material.elastic{ name = "soft",  young = 5*GPa,  poisson = 0.3, density = 1200 }
local function block(name, material_, from, size, cells, integration)
  return substructure{ name = name, material = material_, integration = integration,
    mesh = mesh.box{ origin = from, size = size, cells = cells } }
end
local implicit = p.explicit == 1 and "implicit" or nil
local foot   = block("foot", steel, { 0, 0, 0 }, { 30*mm, 10*mm, 8*mm }, { 6, 2, 2 }, implicit)
local slab   = block("slab", soft, { 0, 0, 8*mm }, { 20*mm, 10*mm, 10*mm }, { 4, 2, 2 }, p.explicit == 1 and "explicit" or nil)
local bolt   = block("bolt", steel, { 25*mm, 0, 8*mm }, { 5*mm, 10*mm, 10*mm }, { 1, 2, 2 }, implicit)
local left   = block("left", steel, { 0, 0, 18*mm }, { 10*mm, 10*mm, 6*mm }, { 2, 2, 2 }, implicit)
local middle = block("middle", steel, { 10*mm, 0, 18*mm }, { 10*mm, 10*mm, 6*mm }, { 2, 2, 2 }, implicit)
local right  = block("right", steel, { 20*mm, 0, 18*mm }, { 10*mm, 10*mm, 6*mm }, { 2, 2, 2 }, implicit)

local shank = interface.plastic{ name = "shank", between = { bolt:face "zmax", right:face "zmin" }, yield = 150*MPa, hardening = 50*MPa/mm }
local under = interface.contact{ name = "under", between = { foot:face "zmax", slab:face "zmin" }, friction = 0.2 }
local over  = interface.contact{ name = "over", between = { slab:face "zmax", left:face "zmin" }, friction = 0.2 }
local over2 = interface.contact{ name = "over2", between = { slab:face "zmax", middle:face "zmin" }, friction = 0.2 }
local tie1  = interface.bonded{ name = "tie1", between = { left:face "xmax", middle:face "xmin" } }
local tie2  = interface.bonded{ name = "tie2", between = { middle:face "xmax", right:face "xmin" } }
local thread = interface.bonded{ name = "thread", between = { foot:face "zmax", bolt:face "zmin" } }

local tighten = step.static{ name = "tighten", increments = 4,
  loads = { p.preload == 1 and load.preload{ on = shank, force = 4*kN } or load.shortening{ on = shank, by = 5*um } } }
local strike = step.dynamic{ name = "strike", after = tighten, duration = p.us * us, dt = 1*us,
  loads = { load.pressure{ on = left:face "zmax", history = function(t)
    if p.broken == 1 and math.abs(t - 20*us) < 1*us / 1000 then error "no record at 20 us" end
    return t < 20*us and 60*MPa * math.sin(math.pi * t / (20*us)) or 0
  end } } }

local above = output.history{ name = "above", on = right:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
problem{
  name = "stopped", substructures = { foot, slab, bolt, left, middle, right },
  interfaces = { shank, under, over, over2, tie1, tie2, thread },
  supports = { support.fixed{ name = "floor", on = foot:face "zmin" } },
  steps = { tighten, strike },
  solver = solver.latin{ integration = "implicit", window = p.window > 1 and math.tointeger(p.window) or nil, spectra = p.passes == 1 and 0.01 or nil, tolerance = p.tolerance },
  outputs = { above, output.srs{ name = "srs", of = above, q_factor = 10, from = 5*kHz, to = 100*kHz },
    output.joint{ name = "joint", on = under }, output.joint{ name = "bolt", on = shank }, output.energy{},
    output.vtk{ frames = 20, fields = { "displacement", "stress" } } },
}:run{}
