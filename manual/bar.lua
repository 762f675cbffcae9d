-- bar.lua: a bar thrown at a rigid wall; while it touches, it presses with density * wave speed * velocity.
local p = param{ n = 100 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000 }
local bar = substructure{
  name = "bar", material = steel, velocity = { 0, 0, -1 },
  mesh = mesh.box{ size = { 5*mm, 5*mm, 100*mm }, cells = { 1, 1, p.n } },
}
local wall = support.wall{ name = "wall", on = bar:face "zmin" }
local guide = support.symmetry{ name = "guide", on = { bar:face "xmin", bar:face "ymin" } }
local hit = step.dynamic{ name = "hit", duration = 60*us, dt = 20*us / p.n }  -- a wave crosses one cell per step
local force = output.resultant{ name = "force", on = wall }
local result = problem{
  name = "bar", substructures = { bar }, supports = { wall, guide }, steps = { hit },
  outputs = { force, output.energy{}, output.vtk{ frames = 30 } },
}:run{}
print(("pressure %.2f MPa in the middle of the contact"):format(-result[force].normal:at(20*us) / (5*mm)^2 / MPa))
