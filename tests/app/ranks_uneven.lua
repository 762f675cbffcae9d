-- Long blocks and a short one in a row, tied and on friction: few bodies, of which some have most of what there is to do. Several ranks cut them.
local p = param{ cells = 4, bodies = 3, long = 4, us = 12, implicit = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local blocks, joints, from = {}, {}, 0
for i = 1, p.bodies do
  local along = (i < p.bodies or i == 1) and p.long or 1
  blocks[i] = substructure{ name = ("block %d"):format(i), material = steel, integration = p.implicit == 1 and "implicit" or "explicit",
    mesh = mesh.box{ origin = { from, 0, 0 }, size = { along * 10*mm, 10*mm, 10*mm }, cells = { along * p.cells, p.cells, p.cells } } }
  from = from + along * 10*mm
end
for i = 2, p.bodies do
  local faces = { blocks[i - 1]:face "xmax", blocks[i]:face "xmin" }
  joints[i - 1] = i % 2 == 0 and interface.contact{ name = ("seam %d"):format(i), between = faces, friction = 0.3 }
    or interface.bonded{ name = ("tie %d"):format(i), between = faces }
end
local strike = load.traction{ on = blocks[#blocks]:face "zmax", x = history.half_sine{ peak = -30*MPa, duration = 6*us }, z = history.half_sine{ peak = 20*MPa, duration = 6*us } }
local far = output.history{ name = "far", on = blocks[1]:face "zmax", quantity = "velocity", direction = { 1, 0, 0 } }
problem{ name = "uneven", substructures = blocks, interfaces = joints, supports = { support.fixed{ name = "end", on = blocks[1]:face "xmin" } },
  steps = { step.dynamic{ name = "strike", duration = p.us * us, dt = 0.25*us, loads = { strike } } },
  solver = solver.latin{ tolerance = 1e-8, mass = "lumped" }, outputs = { far, output.energy{}, output.vtk{ frames = 3, fields = { "displacement", "stress" } } } }:run{}
