local ply = material.orthotropic{ name = "ply", e1 = 140*GPa, e2 = 10*GPa, e3 = 10*GPa, nu12 = 0.3, nu13 = 0.3, nu23 = 0.45, g12 = 5*GPa, g13 = 5*GPa, g23 = 3.4*GPa, density = 1600 }
local skin = material.laminate{ name = "skin", plies = { { material = ply, thickness = 2*mm } } }
local plate = substructure{ name = "plate", material = skin, orientation = { { 1, 0, 0 }, { 0, 1, 1 } }, mesh = mesh.box{ size = { 20*mm, 10*mm, 2*mm }, cells = { 4, 2, 1 } } }
