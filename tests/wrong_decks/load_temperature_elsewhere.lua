local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local base = support.fixed{ name = "base", on = box:face "zmin" }
local other = substructure{ name = "other", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local warm = step.static{ name = "warm", loads = { load.temperature{ parts = { other }, expansion = 12e-6, by = 100 } } }
problem{ name = "p", substructures = { box }, supports = { base }, steps = { warm } }:run{}
