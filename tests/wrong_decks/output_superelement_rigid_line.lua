local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", mesh = mesh.box{ size = { 1*mm, 1*mm, 8*mm }, cells = { 2, 2, 8 } }, material = steel }
local line = bar:where(function(x, y, z) return near(x, 0.5*mm) and near(y, 0) and z > 3.9*mm and z < 6.1*mm end)
local ends = support.fixed{ name = "ends", on = { bar:face "zmin", bar:face "zmax" } }
local element = output.superelement{ name = "element", on = line, motion = "rigid", modes = 24 }
problem{ name = "rigid", substructures = { bar }, supports = { ends }, steps = { step.static{ name = "s" } }, outputs = { element } }:check()
