local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local file = mesh.step{ file = "../../meshes/joint.step", size = 9*mm, round = 8 }
local lower = substructure{ name = "lower", mesh = file:part "lower", material = steel }
local upper = substructure{ name = "upper", mesh = file:part "upper", material = steel }
local screws = bolt.through{ name = "screw", size = "M8", parts = { upper, lower }, material = steel, head = { 0, 0, -1 } }
