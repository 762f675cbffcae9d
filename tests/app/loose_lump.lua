-- Two bodies, each of two lumps of which nothing holds the upper one: no factor, found inside a parallel region.
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local file = mesh.gmsh{ file = "loose_lump.geo" }
local parts, supports = {}, {}
for i = 1, 2 do
  parts[i] = substructure{ name = "part " .. i, material = alloy, mesh = file:volume "block", place = { 0.1 * i, 0, 0 } }
  supports[i] = support.fixed{ name = "base " .. i, on = parts[i]:face "bottom" }
end
problem{
  name = "loose_lump", substructures = parts, supports = supports, outputs = { output.energy{} },
  steps = { step.static{ name = "press", loads = { load.gravity{ z = -9.81 } } } },
}:run{}
