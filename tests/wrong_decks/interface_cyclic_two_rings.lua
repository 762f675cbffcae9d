local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local part = substructure{ name = "part", material = steel, mesh = mesh.gmsh{ file = "../../meshes/wedge.geo", set = { to = 45, n_radial = 1, n_around = 2, n_high = 1 } }:volume "wedge" }
local cut = interface.cyclic{ name = "cut", between = { part:face "left", part:face "right" }, axis = { 0, 0, 1 }, n = 8 }
local other = substructure{ name = "other", material = steel, mesh = mesh.gmsh{ file = "../../meshes/wedge.geo", set = { to = 60, low = 0.1, high = 0.2, n_radial = 1, n_around = 2, n_high = 1 } }:volume "wedge" }
local second = interface.cyclic{ name = "second", between = { other:face "left", other:face "right" }, axis = { 0, 0, 1 }, n = 6 }
local base = support.fixed{ name = "base", on = { part:face "bottom", other:face "bottom" } }
local rest = step.static{ name = "rest", loads = { load.gravity{ z = -9.81 } } }
problem{ name = "sector", substructures = { part, other }, interfaces = { cut, second }, supports = { base }, steps = { rest } }:run{}
