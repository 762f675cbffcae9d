local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local modes = output.modes{ name = "modes" }
local tip = output.history{ name = "tip", on = box:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local down = output.ringdown{ name = "down", of = tip, band = { 5*kHz, 9*kHz }, mode = modes, number = 7 }
