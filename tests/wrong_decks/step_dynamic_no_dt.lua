local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local hold = step.dynamic{ name = "hold", duration = 60 }
problem{ name = "p", substructures = { box }, steps = { hold }, outputs = { output.energy{} } }
