local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local glue = interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local push = load.pressure{ on = high:face "zmax", history = history.half_sine{ peak = 1*MPa, duration = 10*us } }
local shot = step.dynamic{ name = "shot", duration = 10*us, dt = 1*us, loads = { push } }
local force = output.resultant{ name = "force", on = glue }
local p = problem{
  name = "pair", substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { shot }, outputs = { force },
}
local shake = load.base_acceleration{ on = base, direction = { 0, 0, 1 }, history = history.file{ file = "shock_in_no_unit.csv" } }
local more = step.dynamic{ name = "more", duration = 10*us, dt = 1*us, loads = { shake } }
problem{ name = "more", substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { more } }
