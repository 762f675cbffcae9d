local function block(name, z) return substructure{ name = name, material = material.elastic{ name = name, young = 200*GPa, poisson = 0, density = 7800 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 }, origin = { 0, 0, z } } } end
local low, up = block("low", 0), block("up", 10*mm)
ensemble{ n = 4, vary = { mu = normal(0.1, 0.2), p = uniform(1, 2)*MPa }, of = function(v)
  local c = interface.contact{ name = "c", between = { low:face "zmax", up:face "zmin" }, friction = v.mu }
  return problem{ name = "blocks", substructures = { low, up }, interfaces = { c }, supports = { support.fixed{ name = "base", on = low:face "zmin" } },
    steps = { step.static{ name = "press", loads = { load.pressure{ on = up:face "zmax", history = v.p } } } } }
end }:run{}
