local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local parts, seats = {}, {}
for k = 1, 3 do
  parts[k] = substructure{ name = "brick" .. k, material = alloy, velocity = { 0, 0, -1 },
    mesh = mesh.box{ origin = { 0, 0, (k - 1)*5*mm }, size = { 5*mm, 5*mm, 5*mm }, cells = { 1, 1, 1 } } }
  if k > 1 then seats[#seats + 1] = interface.contact{ name = "seat" .. k, between = { parts[k - 1], parts[k] }, friction = 0.3 } end
end
local wall = support.fixed{ name = "wall", on = parts[1]:face "zmin" }
local fly = step.dynamic{ name = "fly", duration = 5*us, dt = 0.5*us, loads = { load.base_acceleration{ on = wall, direction = { 0, 0, 1 }, history = function(t) return 1e4*math.sin(1e5*t) end } } }
local push, energy = output.resultant{ name = "push", on = wall }, output.energy{}
local result = problem{ name = "thrown", substructures = parts, interfaces = seats, supports = { wall }, steps = { fly }, outputs = { push, energy },
  solver = solver.latin{ window = 2, mass = "tuned", spectra = 0.1 } }:run{}
print(("%g %g"):format(result[push].normal.max, result[energy].balance.last))
