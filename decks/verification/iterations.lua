-- iterations.lua -- a block of bonded bricks, pressed and sheared on a rough middle plane: what the iteration costs.
--
--        | | | |  /                     nx x ny x nz bricks, tied to each other; friction where the two
--      +----+----+                      halves meet; ratio = stiffness of the upper half over that of the
--      |    |    |                      lower one; cfl = c_P dt/h of the stiffer half
--      +====+====+ contact, friction
--      |    |    |
--      +----+----+
--      ///////////
--
-- Run        dygita run decks/verification/iterations.lua --set cfl=10 --set nx=4 --set ny=4 --set nz=4
--            python3 manual/verification/iterations.py build/dygita        prints the table of the manual
-- See        paraview out/iterations/base/iterations.pvd
-- Expect     iterations per step that depend little on the number of bricks
-- Read next  bonded_is_monolithic.lua

local p = param{ nx = 2, ny = 2, nz = 2, cells = 12, cfl = 1, ratio = 1, friction = 0.3, static = 0, steps = 40, tie = 0 }

local side = 24*mm
local h = side / p.cells
local function stuff(name, young) return material.elastic{ name = name, young = young, poisson = 0.3, density = 7800 } end
local lower, upper = stuff("lower", 210*GPa / math.max(p.ratio, 1)), stuff("upper", 210*GPa * math.min(p.ratio, 1))
local c_p = math.sqrt(210*GPa * 0.7 / (1.3 * 0.4) / 7800)
local dt = p.cfl * h / c_p

local n = { p.nx, p.ny, p.nz }
local at, bricks, interfaces, top, bottom = {}, {}, {}, {}, {}
local function key(i, j, k) return i .. "." .. j .. "." .. k end
for k = 1, p.nz do for j = 1, p.ny do for i = 1, p.nx do
  local size, cells, origin = {}, {}, {}
  for d, index in ipairs{ i, j, k } do
    size[d], cells[d] = side / n[d], p.cells // n[d]
    origin[d] = (index - 1) * size[d]
  end
  local part = substructure{
    name = "brick" .. key(i, j, k), material = k <= p.nz // 2 and lower or upper,
    mesh = mesh.box{ origin = origin, size = size, cells = cells },
  }
  at[key(i, j, k)] = part
  bricks[#bricks + 1] = part
  if k == 1 then bottom[#bottom + 1] = part:face "zmin" end
  if k == p.nz then top[#top + 1] = part:face "zmax" end
end end end

local function join(name, a, b)
  if a and b then interfaces[#interfaces + 1] = interface.bonded{ name = name, between = { a, b } } end
end
local mating
for k = 1, p.nz do for j = 1, p.ny do for i = 1, p.nx do
  local one = at[key(i, j, k)]
  if i < p.nx then join("x" .. key(i, j, k), one:face "xmax", at[key(i + 1, j, k)]:face "xmin") end
  if j < p.ny then join("y" .. key(i, j, k), one:face "ymax", at[key(i, j + 1, k)]:face "ymin") end
  if k < p.nz then
    local faces = { one:face "zmax", at[key(i, j, k + 1)]:face "zmin" }
    if k == p.nz // 2 and p.tie == 0 then
      mating = interface.contact{ name = "z" .. key(i, j, k), between = faces, friction = p.friction }
      interfaces[#interfaces + 1] = mating
    else
      join("z" .. key(i, j, k), faces[1], faces[2])
    end
  end
end end end

local base = support.fixed{ name = "base", on = bottom }
local length = p.steps * dt
local steps
if p.static == 1 then
  local press = step.static{ name = "press", increments = 2, loads = { load.traction{ on = top, z = -50*MPa } } }
  local shear = step.static{ name = "shear", after = press, increments = 2, loads = { load.traction{ on = top, z = -50*MPa, x = 10*MPa } } }
  steps = { press, shear }
else
  steps = { step.dynamic{ name = "hit", duration = length, dt = dt, loads = { load.traction{
    on = top, z = history.half_sine{ peak = -100*MPa, duration = length / 2 }, x = history.half_sine{ peak = 40*MPa, duration = length / 3 } } } } }
end
local corner = output.history{ name = "corner", quantity = p.static == 1 and "displacement" or "velocity",
  on = at[key(p.nx, p.ny, p.nz)]:where(function(x, y, z) return near(x, side) and near(y, side) and near(z, side) end) }
local result = problem{
  name = "iterations", substructures = bricks, interfaces = interfaces, supports = { base }, steps = steps,
  outputs = { corner, output.energy{} },
}:run{}
print(("%.2f iterations per step"):format(result.iterations / (p.static == 1 and 4 or p.steps)))
