local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local one = substructure{ name = "one", material = steel, mesh = mesh.box{ size = { 0.1, 0.01, 0.01 }, cells = { 5, 1, 1 } } }
local two = substructure{ name = "two", material = steel, mesh = mesh.box{ size = { 0.1, 0.01, 0.01 }, cells = { 5, 1, 1 }, origin = { 0, 0.02, 0 } } }
local same = support.equation{ name = "same", on = { one:face "xmax", two:face "xmax" }, terms = { { x = 1 }, {} } }
