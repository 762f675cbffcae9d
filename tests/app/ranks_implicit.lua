-- Twelve implicit blocks in a row, no two alike: tied, rubbing under a squeeze, one across a gap that closes, one yielding,
-- the last against a rough wall; two of them struck, the first held or driven along. Several ranks share them out, some cut.
local p = param{ us = 12, cut = 1, window = 1, driven = 0, release = 0, explicit = 0, heavy = 0, tolerance = 1e-6 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local soft = material.elastic{ name = "soft", young = 70*GPa, poisson = 0.3, density = 2700 }
local n = 12
local blocks, joints, from = {}, {}, 0
for i = 1, n do
  local length = (6 + 0.37 * i) * mm
  blocks[i] = substructure{ name = ("block %d"):format(i), material = i % 4 == 0 and soft or steel,
    integration = i <= p.explicit and "explicit" or "implicit",
    mesh = mesh.box{ origin = { from, 0, 0 }, size = { length, 8*mm, 9*mm }, cells = { 3 + i % 3, 3, 3 }, order = p.heavy == 1 and 2 or 1 } }
  from = from + length
end
for i = 2, n do
  local faces = { blocks[i - 1]:face "xmax", blocks[i]:face "xmin" }
  local name = ("joint %d"):format(i)
  if i == 9 then
    joints[i - 1] = interface.plastic{ name = name, between = faces, yield = 40*MPa, hardening = 50*MPa/mm }
  elseif i % 3 == 0 then
    joints[i - 1] = interface.contact{ name = name, between = faces, friction = 0.25, gap = i == 6 and 0.05*um or 0*um }
  else
    joints[i - 1] = interface.bonded{ name = name, between = faces }
  end
end
local squeeze = load.pressure{ on = blocks[n]:face "xmax", history = 20*MPa }
local loads = { squeeze, load.traction{ on = blocks[2]:face "zmax", z = history.half_sine{ peak = 60*MPa, duration = 4*us } },
  load.traction{ on = blocks[8]:face "zmax", x = history.half_sine{ peak = -90*MPa, duration = 3*us } } }
if p.release > 0 then table.insert(loads, load.release{ on = joints[10], at = p.release * us }) end
if p.driven == 1 then table.insert(loads, load.velocity{ on = blocks[1]:face "ymin", z = history.haversine{ peak = 1, duration = 6*us } }) end
if p.heavy == 1 then table.insert(loads, load.gravity{ x = -1e5, z = -2e5 }) end
local press = step.static{ name = "press", increments = 2, loads = { squeeze } }
local strike = step.dynamic{ name = "strike", after = press, duration = p.us * us, dt = 0.25*us, loads = loads }
local corner = output.history{ name = "corner", on = blocks[n]:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local outputs = { corner, output.energy{}, output.vtk{ frames = 6, fields = { "displacement", "stress" } } }
for _, i in ipairs{ 2, 5, 8, 11 } do table.insert(outputs, output.joint{ name = joints[i].name, on = joints[i] }) end
table.insert(outputs, output.modes{ name = "modes", n = 8, after = press })
problem{ name = "implicit", substructures = blocks, interfaces = joints, steps = { press, strike }, outputs = outputs,
  supports = { p.driven == 1 and support.symmetry{ name = "end", on = blocks[1]:face "xmin" } or support.fixed{ name = "end", on = blocks[1]:face "xmin" }, support.wall{ name = "side", on = blocks[n]:face "ymin", friction = 0.15 } },
  solver = solver.latin{ static_steps = "iterated", tolerance = p.tolerance, window = p.window > 1 and math.tointeger(p.window) or nil,
    pieces = p.cut > 1 and math.tointeger(p.cut) or nil } }:run{}
