local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local part = substructure{ name = "part", material = steel, mesh = mesh.gmsh{ file = "../../meshes/wedge.geo", set = { to = 45, n_radial = 1, n_around = 2, n_high = 1 } }:volume "wedge" }
local moving = substructure{ name = "moving", material = steel, velocity = { 1, 0, 0 }, mesh = mesh.gmsh{ file = "../../meshes/wedge.geo", set = { to = 45, n_radial = 1, n_around = 2, n_high = 1 } }:volume "wedge" }
local cut = interface.cyclic{ name = "cut", between = { moving:face "left", moving:face "right" }, axis = { 0, 0, 1 }, n = 8 }
local fly = step.dynamic{ name = "fly", duration = 1*ms, dt = 10*us }
problem{ name = "sector", substructures = { moving }, interfaces = { cut }, steps = { fly } }:run{}
