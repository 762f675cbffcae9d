local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
substructure{ name = "a", material = steel, orientation = { { 1, 0, 0 }, { 0, 1, 0 } }, mesh = mesh.box{ size = { 1*mm, 1*mm, 1*mm }, cells = { 1, 1, 1 }, origin = { -0.5*mm, 0, 0 } } }
