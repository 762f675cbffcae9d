local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local shank = interface.bonded{ name = "shank", between = { low:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = shank, force = 8*kN } } }
problem{ name = "screw", substructures = { low, high }, interfaces = { shank }, supports = { base }, steps = { tighten } }:check()
