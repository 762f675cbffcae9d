local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local box = substructure{ name = "box", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local rest = step.static{ name = "rest" }
local modes = output.modes{ name = "m", n = 3, after = rest }
local ring = step.dynamic{ name = "ring", after = rest, duration = 1*us, dt = 0.1*us }
local backbone = output.backbone{ name = "b", mode = modes, number = 7, steps = ring }
problem{ name = "p", substructures = { box }, steps = { rest, ring }, outputs = { modes, backbone } }
