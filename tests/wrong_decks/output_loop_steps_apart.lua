local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local touch = interface.contact{ name = "touch", between = { low:face "zmax", high:face "zmin" }, friction = 0.2 }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local rest = step.static{ name = "rest" }
local load = step.static{ name = "load", after = rest }
local back = step.static{ name = "back", after = load }
local loop = output.loop{ name = "loop", on = touch, direction = { 1, 0, 0 }, steps = { rest, back } }
problem{ name = "p", substructures = { low, high }, interfaces = { touch }, supports = { base }, steps = { rest, load, back }, outputs = { loop } }:run{}
