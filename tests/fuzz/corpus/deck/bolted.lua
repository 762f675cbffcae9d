local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, k, cells)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, k*10*mm }, size = { 10*mm, 10*mm, 10*mm }, cells = cells or { 1, 1, 1 } } }
end
local a, b, c = block("a", 0), block("b", 1), block("c", 2, { 2, 2, 1 })
local shank = interface.plastic{ name = "shank", between = { a:face "zmax", b:face "zmin" }, yield = 150*MPa, hardening = 50*MPa/mm }
local seat = interface.contact{ name = "seat", between = { b:face "zmax", c:face{ normal = { 0, 0, -1 }, at = -20*mm } }, friction = 0.3, points = "first" }
local oil = interface.viscous{ name = "oil", between = { b, c }, normal = 1e5, tangential = 1e4 }
local wall = support.wall{ name = "wall", on = c:face "zmax", gap = 0.1*mm, friction = 0.1 }
local fixed = support.fixed{ name = "fixed", on = a:face "zmin" }
local mirror = support.symmetry{ name = "mirror", on = { a:face "xmin", b:face "xmin" } }
local tighten = step.static{ name = "tighten", increments = 2, loads = { load.preload{ on = shank, force = 2*kN,
  hand = { diameter = 8*mm, grip = 20*mm, head = 13*mm, hole = 9*mm, outer = 30*mm, young = 210*GPa, plate_young = 70*GPa } } } }
local shake = step.static{ name = "shake", after = tighten, increments = 4, loads = { load.force{ on = c:face "xmax", x = history.piecewise{ times = { 0, 0.5, 1 }, values = { 0, 1e7, -1e7 } } } } }
local loop = output.loop{ name = "loop", on = seat, direction = { 1, 0, 0 }, after = tighten, steps = { shake } }
local condensed = output.superelement{ name = "condensed", on = c:face "zmax", modes = 2, motion = "rigid" }
problem{ name = "bolted", substructures = { a, b, c }, interfaces = { shank, seat }, supports = { fixed, mirror }, steps = { tighten, shake },
  outputs = { loop, condensed, output.joint{ name = "bolt", on = shank } }, solver = solver.monolithic{} }:run{}
