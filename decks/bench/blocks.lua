-- blocks.lua -- a cube cut into bricks: contact with friction across its middle, all other cuts bonded. A scene for timings.
--
--       v v v  oblique pressure on part of the top
--     +--+--+--+--+
--     +--+--+--+--+
--     +==+==+==+==+   contact, friction
--     +--+--+--+--+
--     +--+--+--+--+   on a fixed base
--
-- Run        dygita run decks/bench/blocks.lua          --set cells=32 --set bx=4 --set by=4 --set bz=4     --set cfl=10
-- See        ./run.sh bench scenes, the chapter manual/performance.md
-- Expect     every step converged. Cells along each side, bricks along x, y and z (bz even), c_P dt / h of the time steps;
--            press = 1: a static step before. Two times as many cells are eight times as many unknowns
-- Read next  ../bolted_flanges.lua

local p = param{ cells = 16, bx = 2, by = 2, bz = 2, cfl = 1, steps = 40, mu = 0.3, press = 0, tolerance = 1e-6 }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local side = 40*mm
local h = side / p.cells
local dt = p.cfl * h / math.sqrt(210*GPa * 0.7 / (1.3 * 0.4) / 7800)

-- Bricks of whole cells: the first ones get what is left over.
local function cuts(n)
  local at = { 0 }
  for i = 1, n do at[i + 1] = (p.cells * i) // n end
  return at
end
local xs, ys, zs = cuts(p.bx), cuts(p.by), cuts(p.bz)

local parts, joints, top, bottom = {}, {}, {}, {}
local function at(i, j, k) return parts[((i - 1) * p.by + j - 1) * p.bz + k] end
for i = 1, p.bx do for j = 1, p.by do for k = 1, p.bz do
  local cells = { xs[i + 1] - xs[i], ys[j + 1] - ys[j], zs[k + 1] - zs[k] }
  parts[#parts + 1] = substructure{
    name = ("brick_%d_%d_%d"):format(i, j, k), material = steel,
    mesh = mesh.box{ origin = { xs[i] * h, ys[j] * h, zs[k] * h }, size = { cells[1] * h, cells[2] * h, cells[3] * h }, cells = cells },
  }
end end end
local function join(a, face_a, b, face_b, touches)
  local name, between = "joint" .. #joints + 1, { a:face(face_a), b:face(face_b) }
  joints[#joints + 1] = touches and interface.contact{ name = name, between = between, friction = p.mu }
    or interface.bonded{ name = name, between = between }
end
for i = 1, p.bx do for j = 1, p.by do for k = 1, p.bz do
  if i < p.bx then join(at(i, j, k), "xmax", at(i + 1, j, k), "xmin") end
  if j < p.by then join(at(i, j, k), "ymax", at(i, j + 1, k), "ymin") end
  if k < p.bz then join(at(i, j, k), "zmax", at(i, j, k + 1), "zmin", k == p.bz // 2) end
  if k == p.bz then top[#top + 1] = at(i, j, k):face "zmax" end
  if k == 1 then bottom[#bottom + 1] = at(i, j, k):face "zmin" end
end end end

local base = support.fixed{ name = "base", on = bottom }
local press = p.press == 1 and step.static{ name = "press", loads = { load.traction{ on = top, x = 4*MPa, z = -20*MPa } } } or nil
local hit = step.dynamic{
  name = "hit", after = press, duration = p.steps * dt, dt = dt,
  loads = {
    load.traction{
      on = top[1],
      x = history.half_sine{ peak = 30*MPa, duration = 20 * h / 6000 }, z = history.half_sine{ peak = -100*MPa, duration = 20 * h / 6000 },
    },
  },
}

local result = problem{
  name = "blocks", substructures = parts, interfaces = joints, supports = { base }, steps = press and { press, hit } or { hit },
  solver = solver.latin{ tolerance = p.tolerance }, outputs = { output.energy{} },
}:run{}
print(("%d bricks, %.1f iterations per step: %s"):format(#parts, result.mean_iterations, result.converged and "converged" or "NOT converged"))
