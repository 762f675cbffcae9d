-- A small run with every section of report.html: tightened, shocked, a spectrum with its specification, contact that slides.
local steel = material.elastic{ name = "steel & more", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, origin = { 0, 0, z }, cells = { 2, 2, 2 } } } end
local low, high = block("low", 0), block("high", 10*mm)
local touch = interface.contact{ name = "touch", between = { low:face "zmax", high:face "zmin" }, friction = 0.2 }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local guide = support.symmetry{ name = "guide", on = { high:face "xmin", high:face "ymin" } }
local press = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = high:face "zmax", history = 20*MPa } } }
local shock = step.dynamic{ name = "shock", after = press, duration = 40*us, dt = 0.5*us, loads = {
  load.pressure{ on = high:face "zmax", history = 20*MPa },
  load.traction{ on = high:face "zmax", z = history.half_sine{ peak = 80*MPa, duration = 20*us } } } }
local a = output.history{ name = "top", on = high:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
problem{ name = "page", substructures = { low, high }, interfaces = { touch }, supports = { base, guide }, steps = { press, shock }, solver = solver.latin{ integration = "implicit" },
  outputs = { a, output.joint{ name = "grip", on = touch }, output.energy{}, output.vtk{ frames = 4 }, output.resultant{ name = "foot", on = base },
    output.history{ name = "motion", on = high:face "zmax", quantity = "displacement" },
    output.srs{ name = "srs_top", of = a, from = 1*kHz, to = 100*kHz, specification = { {1*kHz, 100*g0}, {10*kHz, 4000*g0}, {100*kHz, 4000*g0} } } },
}:run{}
