-- Fifteen blocks on a ring: bolted flanges in small, each tied to the next or on it by friction, a pulse on one of them.
-- Several ranks share the blocks out, some of them cut.
local p = param{ parts = 15, us = 60, cut = 0, peak = 30*MPa, release = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, yield = 900*MPa }
local blocks, joints, watched = {}, {}, nil
for i = 1, p.parts do
  blocks[i] = substructure{ name = ("block %d"):format(i), material = steel,
    mesh = mesh.box{ origin = { (i - 1) * 10*mm, 0, 0 }, size = { 10*mm, 10*mm, 10*mm }, cells = { i % 3 + 2, 4, 4 } } }
end
for i = 2, p.parts do
  local faces = { blocks[i - 1]:face "xmax", blocks[i]:face "xmin" }
  if i % 3 == 0 then
    joints[#joints + 1] = interface.contact{ name = ("seam %d"):format(i), between = faces, friction = 0.3 }
    watched = watched or joints[#joints]
  else
    joints[#joints + 1] = interface.bonded{ name = ("tie %d"):format(i), between = faces }
  end
end
local loads = { load.pressure{ on = blocks[p.parts]:face "xmax", history = 20*MPa },
  load.traction{ on = blocks[1]:face "zmax", z = history.half_sine{ peak = p.peak, duration = 20*us } } }
local last = joints[#joints - 1]    -- a tie, far from the pulse
if p.release > 0 then table.insert(loads, load.release{ on = last, at = p.release * us }) end
local press = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = blocks[p.parts]:face "xmax", history = 20*MPa } } }
local shock = step.dynamic{ name = "shock", after = press, duration = p.us * us, dt = 0.5*us, loads = loads }
local far = output.history{ name = "far", on = blocks[p.parts]:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local result = problem{ name = "ranks", substructures = blocks, interfaces = joints,
  supports = { support.fixed{ name = "end", on = blocks[1]:face "xmin" } }, steps = { press, shock },
  solver = solver.latin{ static_steps = "iterated", pieces = p.cut > 0 and math.tointeger(p.cut) or nil },
  outputs = { far, output.srs{ name = "srs", of = far, q_factor = 10, from = 1*kHz, to = 100*kHz }, output.joint{ name = "joint", on = watched }, output.joint{ name = "last", on = last },
    output.energy{}, output.vtk{ frames = 5, fields = { "displacement", "stress" } } },
}:run{}
print(("largest %.6g m/s^2, stress %.6g MPa"):format(result[far].max, result[blocks[1]].von_mises / MPa))
