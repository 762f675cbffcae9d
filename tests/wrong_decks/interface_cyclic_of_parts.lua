local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local part = substructure{ name = "part", material = steel, mesh = mesh.gmsh{ file = "../../meshes/wedge.geo", set = { to = 45, n_radial = 1, n_around = 2, n_high = 1 } }:volume "wedge" }
local cut = interface.cyclic{ name = "cut", between = { part, part }, axis = { 0, 0, 1 }, n = 8 }
