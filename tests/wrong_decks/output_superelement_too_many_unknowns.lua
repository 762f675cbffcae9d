local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", mesh = mesh.box{ size = { 200*mm, 20*mm, 20*mm }, cells = { 50, 6, 6 } }, material = steel }
local held = support.fixed{ name = "held", on = bar:face "xmin" }
local element = output.superelement{ name = "element", on = bar:where(function(x, y, z) return x > 1*mm end), up_to = 1*kHz }
problem{ name = "large", substructures = { bar }, supports = { held }, steps = { step.static{ name = "rest" } }, outputs = { element } }:check()
