local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local rest = step.static{ name = "rest" }
local modes = output.modes{ name = "m", n = 3, after = rest }
local push = step.static{ name = "push", after = rest, loads = { load.mode{ mode = modes, number = 7, parts = { box }, value = 1 } } }
problem{ name = "p", substructures = { box }, steps = { rest, push }, outputs = { output.energy{} } }
