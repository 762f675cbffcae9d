local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping_ratio = 0.015, damping_band = { 100, 10*kHz } }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local weld = interface.bonded{ name = "weld", between = { low:face "zmax", high:face "zmin" } }
local out = support.fixed{ name = "out", on = low:face "zmin" }
local rest = step.static{ name = "rest" }
local element = output.superelement{ name = "element", on = high:face "zmax", up_to = 10*kHz }
problem{ name = "p", substructures = { low, high }, interfaces = { weld }, supports = { out }, steps = { rest }, outputs = { element } }
