local p = param{ n = 1, mu = 0.2, force = 4*kN }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, yield = 600*MPa, damping_ratio = 0.02, damping_frequency = 1*kHz }
local soft = material.elastic{ name = "soft", young = 5*GPa, poisson = 0.3, density = 1200, damping = { mass = 1, stiffness = 1e-7 } }
local low = substructure{ name = "low", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 5*mm }, cells = { 1, 1, p.n } } }
local high = substructure{ name = "high", material = soft, mesh = mesh.box{ size = { 10*mm, 10*mm, 5*mm }, cells = { 1, 1, 1 } }, place = { 0, 0, 5*mm } }
local side = substructure{ name = "side", material = steel, mesh = mesh.box{ size = { 5*mm, 10*mm, 5*mm }, cells = { 1, 2, 1 }, cell = "tet4" }, place = { translate = { 10*mm, 0, 0 }, rotate = { axis = { 0, 0, 1 }, angle = 0*deg } } }
local touch = interface.contact{ name = "touch", between = { low:face "zmax", high:face "zmin" }, friction = p.mu, gap = 0 }
local tie = interface.bonded{ name = "tie", between = { low:face "xmax", side:face "xmin" } }
local floor = support.fixed{ name = "floor", on = low:face "zmin" }
local push = load.pressure{ on = high:face "zmax", history = history.half_sine{ peak = 8*MPa, duration = 5*us } }
local hold = step.static{ name = "hold", increments = 2, loads = { load.traction{ on = high:face "zmax", z = -1*MPa } } }
local ring = step.dynamic{ name = "ring", after = hold, duration = 4*us, dt = 1*us, loads = { push, load.gravity{ z = -9.81 } } }
local top = output.history{ name = "top", on = high:where(function(x, y, z) return near(z, 10*mm) end), quantity = "acceleration", direction = { 0, 0, 1 } }
local joint = output.joint{ name = "joint", on = touch }
local scene = problem{ name = "scene", substructures = { low, high, side }, interfaces = { touch, tie }, supports = { floor }, steps = { hold, ring },
  solver = solver.latin{ tolerance = 1e-4 },
  outputs = { top, joint, output.srs{ name = "srs", of = top, q_factor = 10, from = 5*kHz, to = 100*kHz }, output.energy{},
    output.footprint{ name = "foot", on = touch }, output.resultant{ name = "sum", on = floor }, output.momentum{ name = "momentum", of = high },
    output.vtk{ frames = 2, fields = { "displacement", "von_mises" } } } }
local result = scene:run{ case = "base", at = { mu = p.mu } }
print(result[joint].normal.max, result[top].max, result.iterations, #result[top])
scene:run{ case = "again", start_from = result }
