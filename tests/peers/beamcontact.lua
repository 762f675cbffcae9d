-- CalculiX's deck beamcontact with cells of any size: a beam of 1 x 1.5 x 8 mm, clamped at z = 0, whose end is between two rigid plates over its last
-- half millimetre; a force of 1 kN at (0, 0.75, 4) mm. The deck has nx = 2, ny = 2, nz = 8.
local p = param{ nx = 2, ny = 2, nz = 8 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local beam = substructure{ name = "beam", material = steel, mesh = mesh.box{ size = { 1*mm, 1.5*mm, 8*mm }, cells = { p.nx, p.ny, p.nz }, order = 2, cell = "hex20" } }
local function plate(name, x)
  return substructure{ name = name, material = steel, mesh = mesh.box{ size = { 0.1*mm, 2.5*mm, 1*mm }, cells = { 1, 1, 1 }, origin = { x, -0.5*mm, 7.5*mm } } }
end
local low, high = plate("low", -0.1*mm), plate("high", 1*mm)
local everywhere = function() return true end
local function at(X, Y, Z) return beam:where(function(x, y, z) return math.max(math.abs(x - X), math.abs(y - Y), math.abs(z - Z)) < 0.1*um end) end
local places = { { 1, 0.75, 4 }, { 1, 0.75, 2 }, { 1, 0.75, 6 }, { 1, 0, 7 } }  -- mm, away from the force
local outputs = {}
for i, x in ipairs(places) do outputs[i] = output.history{ name = "place " .. i, on = at(x[1]*mm, x[2]*mm, x[3]*mm), quantity = "displacement" } end
local r = problem{ name = "beamcontact", substructures = { beam, low, high },
  interfaces = { interface.contact{ name = "below", between = { beam:face "xmin", low:face "xmax" } }, interface.contact{ name = "above", between = { beam:face "xmax", high:face "xmin" } } },
  supports = { support.fixed{ name = "ground", on = { beam:face "zmin", low:where(everywhere), high:where(everywhere) } } },
  steps = { step.static{ name = "press", loads = { load.force{ on = at(0, 0.75*mm, 4*mm), x = 1000 } } } }, outputs = outputs }:run{}
for i, x in ipairs(places) do print(("at %g, %g, %g: %.5f mm"):format(x[1], x[2], x[3], 1e3 * r[outputs[i]].x.last)) end
