local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local ring = step.dynamic{ name = "ring", duration = 1*ms, dt = 1*us }
local tip = output.history{ name = "tip", on = box:face "zmax", quantity = "acceleration" }
local down = output.ringdown{ name = "down", of = tip, band = { 5*kHz, 9*kHz } }
problem{ name = "p", substructures = { box }, steps = { ring }, outputs = { tip, down } }
