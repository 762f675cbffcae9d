local ply = material.orthotropic{ name = "ply", e1 = 140*GPa, e2 = 10*GPa, e3 = 10*GPa, nu12 = 0.3, nu13 = 0.3, nu23 = 0.4, g12 = 5*GPa, g13 = 5*GPa, g23 = 3.5*GPa, density = 1600 }
local box = substructure{ name = "box", material = ply, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local hot = load.temperature{ parts = { box }, expansion = 12e-6, by = 100 }
