local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local m8 = bolt.hex{ name = "M8", size = "M8", grip = 10*mm, material = steel, washer = true, friction = 0.15, shank = "nominal", yield = 600*MPa }
local row = pattern.circle{ of = m8, n = 2, axis = { 0, 0, 1 }, about = { 50*mm, 0, 0 } }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = row[1].shank, torque = 20, diameter = 8*mm, friction_factor = 0.2 }, load.shortening{ on = row[2].shank, by = 1*um } } }
problem{ name = "two", substructures = { row.parts }, interfaces = { row.interfaces }, steps = { tighten },
  supports = { support.fixed{ name = "s", on = { row[1].upper, row[1].lower, row[2].upper } } }, outputs = { output.energy{} } }:run{}
