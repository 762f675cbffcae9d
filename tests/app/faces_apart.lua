-- Two blocks a millimetre apart: their interface is found nowhere, and the picture of the check shows it.
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, origin = { 0, 0, z }, cells = { 1, 1, 1 } } } end
local low, high = block("low", 0), block("high", 11*mm)
problem{ name = "apart", substructures = { low, high }, steps = { step.static{ name = "rest" } },
  interfaces = { interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } } },
  supports = { support.fixed{ name = "base", on = low:face "zmin" } } }:run{}
