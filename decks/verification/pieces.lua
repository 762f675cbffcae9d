-- pieces.lua -- a cube cut by the program into pieces: the same answer, and what the cut costs in iterations.
--
--       p(t)
--      v v v v
--     +--+---+-+    pieces as METIS cuts them, bonded
--     | / \  | |
--     +-   +-+-+
--     |  \/  | |
--     +---+--+-+
--    ///////////    rigid wall, contact with friction: the pulse reflects and the cube takes off
--
-- Run        dygita run decks/verification/pieces.lua --set n=16 --set cfl=1
-- Expect     the velocity of the top and the force on the wall differ from those of the uncut cube by less than ten times the
--            tolerance (1e-6) of their largest; the mean number of iterations per step is printed for each number of pieces
-- Read next  bonded_is_monolithic.lua

local p = param{ n = 16, cfl = 1, tolerance = 1e-6, friction = 0.3, transits = 2.5, most = 64, least = 1, only = 0 }

local E, nu, rho, h = 210*GPa, 0.3, 7800, 1*mm
local steel = material.elastic{ name = "steel", young = E, poisson = nu, density = rho }
local c = math.sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / rho)
local side, dt = p.n * h, p.cfl * h / c
local steps = math.max(10, math.floor(p.transits * p.n / p.cfl + 0.5))

local cube = substructure{ name = "cube", material = steel, mesh = mesh.box{ size = { side, side, side }, cells = { p.n, p.n, p.n } } }
local wall = support.wall{ name = "wall", on = cube:face "zmin", friction = p.friction }
local hit = step.dynamic{ name = "hit", duration = steps * dt, dt = dt, loads = { load.traction{ on = cube:face "zmax",
  z = history.half_sine{ peak = -100*MPa, duration = side / c }, x = history.half_sine{ peak = 40*MPa, duration = 0.75 * side / c } } } }
local top = output.history{ name = "top", on = cube:face "zmax", quantity = "velocity" }
local foot = output.joint{ name = "foot", on = wall }

local function run(pieces)
  return problem{ name = "pieces", substructures = { cube }, supports = { wall }, steps = { hit },
    solver = solver.latin{ integration = "implicit", tolerance = p.tolerance, pieces = pieces, max_iterations = 1000 }, outputs = { top, foot } }:run{ case = pieces .. "_pieces" }
end

local function difference(a, b)
  local worst = 0
  for i = 1, #a do worst = math.max(worst, math.abs(a[i] - b[i])) end
  return worst / math.max(a.max, -a.min)
end

if p.only > 0 then
  local one = run(p.only)
  print(("%d pieces: %.1f iterations per step"):format(p.only, one.iterations / steps))
  return
end
local whole = run(1)
print(("1 piece: %.1f iterations per step"):format(whole.iterations / steps))
for _, n in ipairs{ 2, 4, 8, 16, 32, 64 } do
  if n <= p.most and n >= p.least then
    local cut = run(n)
    print(("%d pieces: %.1f iterations per step; difference of the top's velocity: %.1e, of the force on the wall: %.1e"):format(
      n, cut.iterations / steps, difference(whole[top].z, cut[top].z), difference(whole[foot].normal, cut[foot].normal)))
  end
end
