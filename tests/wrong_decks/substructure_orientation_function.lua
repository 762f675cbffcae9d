local ply = material.orthotropic{ name = "ply", e1 = 140*GPa, e2 = 10*GPa, e3 = 9*GPa, nu12 = 0.3, nu13 = 0.25, nu23 = 0.45, g12 = 5*GPa, g13 = 4*GPa, g23 = 3*GPa, density = 1600 }
substructure{ name = "a", material = ply, orientation = function(x, y, z) return { 1, 0, 0 } end, mesh = mesh.box{ size = { 1*mm, 1*mm, 1*mm }, cells = { 1, 1, 1 }, origin = { -0.5*mm, 0, 0 } } }
