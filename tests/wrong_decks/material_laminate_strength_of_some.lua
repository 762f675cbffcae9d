local ply = material.orthotropic{ name = "ply", e1 = 140*GPa, e2 = 10*GPa, e3 = 10*GPa, nu12 = 0.3, nu13 = 0.3, nu23 = 0.45, g12 = 5*GPa, g13 = 5*GPa, g23 = 3.4*GPa, density = 1600 }
local strong = material.elastic{ name = "strong", young = 70*GPa, poisson = 0.3, density = 2700, yield = 300*MPa }
local skin = material.laminate{ name = "skin", plies = { { material = ply, thickness = 1*mm }, { material = strong, thickness = 1*mm } } }
