local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local base = cube:where(function(x, y, z)
  return near(z, 0, "1*mm")
end)
