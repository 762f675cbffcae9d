local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local base = support.fixed{ name = "base", on = box:face "zmin" }
local ring = step.dynamic{ name = "ring", duration = 4*us, dt = 1*us, loads = { load.spin{ speed = 10, axis = { 0, 0, 1 } } } }
problem{ name = "p", substructures = { box }, supports = { base }, steps = { ring } }:run{}
