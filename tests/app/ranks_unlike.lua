-- Four explicit blocks, each of another grid than those it meets: rubbing, tied and rubbing, along a rough wall, with a
-- side that lets waves out; the lowest is held, or driven along a side. Several ranks share them out.
local p = param{ us = 4, driven = 0, beta = 0, tuned = 0, tetrahedra = 0 }
local damped = p.beta > 0 and { stiffness = p.beta } or nil
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = damped }
local soft = material.elastic{ name = "soft", young = 70*GPa, poisson = 0.3, density = 2700, damping = damped }
local blocks = {}
for i, n in ipairs{ 3, 4, 5, 3 } do
  blocks[i] = substructure{ name = ("block %d"):format(i), material = i % 2 == 0 and steel or soft, integration = "explicit",
    mesh = mesh.box{ origin = { 0, 0, (i - 1) * 4*mm }, size = { 6*mm, 6*mm, 4*mm }, cells = { n, n, 3 }, cell = p.tetrahedra == 1 and "tet10" or "hex8" } }
end
local function between(i) return { blocks[i]:face "zmax", blocks[i + 1]:face "zmin" } end
local rubbing = interface.contact{ name = "rubbing", between = between(1), friction = 0.3 }
local tied = interface.bonded{ name = "tied", between = between(2) }
local upper = interface.contact{ name = "upper", between = between(3), friction = 0.2 }
local side = support.wall{ name = "side", on = blocks[2]:face "xmin", friction = 0.15 }
local supports = { side, support.absorbing{ name = "out", on = blocks[2]:face "ymax" } }
local loads = { load.traction{ on = blocks[4]:face "zmax", x = history.half_sine{ peak = 20*MPa, duration = 3*us },
  z = history.half_sine{ peak = -120*MPa, duration = 3*us } } }
if p.driven == 1 then
  loads[2] = load.velocity{ on = blocks[1]:face "xmax", z = history.haversine{ peak = 2, duration = 4*us } }
else
  supports[3] = support.fixed{ name = "base", on = blocks[1]:face "zmin" }
end
local corner = output.history{ name = "corner", on = blocks[4]:face "xmax", quantity = "displacement" }
problem{ name = "unlike", substructures = blocks, interfaces = { rubbing, tied, upper }, supports = supports,
  steps = { step.dynamic{ name = "hit", duration = p.us * us, dt = 0.1*us, loads = loads } },
  solver = solver.latin{ mass = p.tuned == 1 and "tuned" or "lumped" },
  outputs = { corner, output.joint{ name = "rubbing", on = rubbing }, output.joint{ name = "tied", on = tied },
    output.joint{ name = "side", on = side }, output.energy{}, output.vtk{ frames = 4, fields = { "displacement", "stress" } } },
}:run{}
