-- A study of three cases, each from the one before, the last one compared with a start from scratch.
local p = param{ us = 300 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, z }, size = { 20*mm, 20*mm, 10*mm }, cells = { 4, 4, 2 } } }
end
local low, high = block("low", 0), block("high", 10*mm)
local floor = support.fixed{ name = "floor", on = low:face "zmin" }
local joint, before
for _, mu in ipairs{ 0.1, 0.2, 0.3 } do
  local seam = interface.contact{ name = "seam", between = { low:face "zmax", high:face "zmin" }, friction = mu }
  joint = output.joint{ name = "joint", on = seam }
  local press = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = high:face "zmax", history = 20*MPa } } }
  local push = step.dynamic{ name = "push", after = press, duration = p.us * us, dt = 0.5*us, loads = {
    load.pressure{ on = high:face "zmax", history = 20*MPa },
    load.traction{ on = high:face "xmin", x = history.half_sine{ peak = 30*MPa, duration = 30*us } } } }
  before = problem{ name = "study", substructures = { low, high }, interfaces = { seam }, supports = { floor }, steps = { press, push },
    outputs = { joint, output.energy{}, output.vtk{ frames = 10 } },
  }:run{ case = ("mu %g"):format(mu), at = { mu = mu }, start_from = before, check_cold = mu == 0.3 }
  print(("mu %g: slip %.6g um"):format(mu, before[joint].slip.max / um))
end
