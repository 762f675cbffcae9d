-- An ensemble of four pairs of blocks that are struck, small enough to be killed in one of its members.
local p = param{ us = 40, n = 4 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, z }, size = { 20*mm, 20*mm, 10*mm }, cells = { 2, 2, 1 } } }
end
local low, high = block("low", 0), block("high", 10*mm)
local floor = support.fixed{ name = "floor", on = low:face "zmin" }
local top = output.history{ name = "top", on = high:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
local function struck(v)
  local seam = interface.contact{ name = "seam", between = { low:face "zmax", high:face "zmin" }, friction = v.mu }
  local push = step.dynamic{ name = "push", duration = p.us * us, dt = 0.5*us, loads = {
    load.pressure{ on = high:face "zmax", history = history.half_sine{ peak = v.peak, duration = 30*us } } } }
  return problem{ name = "struck", substructures = { low, high }, interfaces = { seam }, supports = { floor }, steps = { push },
    outputs = { top, output.joint{ name = "joint", on = seam }, output.vtk{ frames = 20 } }, solver = solver.latin{ integration = "implicit" } }
end
ensemble{ n = p.n, seed = 3, vary = { mu = uniform(0.1, 0.3), peak = uniform(10, 30)*MPa }, of = struck }:run{ members = true }
