local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 7800 }
local cube = substructure{ name = "cube", material = m, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local turned = frame{ x = { 1, 1, 0 } }
local along = load.velocity{ on = cube:face "xmax", frame = turned, z = 1 }
local aslant = load.velocity{ on = cube:face "xmax", frame = turned, x = 1, z = 1 }
