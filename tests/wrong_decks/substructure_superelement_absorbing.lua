local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure.superelement{ name = "low", file = "element.json" }
local out = support.absorbing{ name = "out", on = low:face "zmax" }
local shock = step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { load.force{ on = low:face "zmax", z = 1 } } }
problem{ name = "p", substructures = { low }, supports = { out }, steps = { shock } }:run{}
