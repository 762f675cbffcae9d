local cube = substructure{ name = "cube", material = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 7800 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local function of(v, dt, n)
  local part = n and substructure{ name = "cube", material = cube.material, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, n } } } or cube
  return problem{ name = "cube", substructures = { part }, steps = { step.dynamic{ name = "hit", duration = 10*us, dt = dt or 1*us,
    loads = { load.pressure{ on = part:face "zmax", history = v.p } } } } }
end
ensemble{ n = 2, vary = { p = uniform(2, 1) }, of = of }:run{}
