local cube = substructure{ name = "cube", material = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 7800 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local function of(p)
  return problem{ name = "cube", substructures = { cube }, steps = { step.dynamic{ name = "hit", duration = 10*us, dt = 1*us,
    loads = { load.pressure{ on = cube:face "zmax", history = p } } } } }
end
ensemble{ n = 2, vary = { p = { { 1, 2 }, each = {} } }, of = function(v)
  local sum = 0
  for _, p in ipairs(v.p) do sum = sum + p end
  for i = 1, 4 do sum = sum + (v.p[i] or 0) end
  return of(sum)
end }:run{}
