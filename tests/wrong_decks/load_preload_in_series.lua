local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local middle = substructure{ name = "middle", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 20*mm } }
local first = interface.bonded{ name = "first", between = { low:face "zmax", middle:face "zmin" } }
local second = interface.bonded{ name = "second", between = { middle:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = { low:face "zmin", high:face "zmax" } }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = first, force = 8*kN }, load.preload{ on = second, force = 5*kN } } }
problem{ name = "two", substructures = { low, middle, high }, interfaces = { first, second }, supports = { base }, steps = { tighten } }:run{}
