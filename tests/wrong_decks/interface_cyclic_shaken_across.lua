local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local part = substructure{ name = "part", material = steel, mesh = mesh.gmsh{ file = "../../meshes/wedge.geo", set = { to = 45, n_radial = 1, n_around = 2, n_high = 1 } }:volume "wedge" }
local cut = interface.cyclic{ name = "cut", between = { part:face "left", part:face "right" }, axis = { 0, 0, 1 }, n = 8 }
local base = support.fixed{ name = "base", on = part:face "bottom" }
local shock = step.dynamic{ name = "shock", duration = 1*ms, dt = 10*us,
  loads = { load.base_acceleration{ on = base, direction = { 1, 0, 0 }, history = history.half_sine{ peak = 100, duration = 1*ms } } } }
problem{ name = "sector", substructures = { part }, interfaces = { cut }, supports = { base }, steps = { shock } }:run{}
