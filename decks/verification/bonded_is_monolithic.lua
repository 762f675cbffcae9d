-- bonded_is_monolithic.lua -- a body cut into bonded pieces is the uncut body, at every node and step looked at.
--
--     p(t), smooth        the same block, cut:
--      v v v v
--     +--------+    +---+----+    +--+--+--+
--     |        |    |   |    |    +--+--+--+
--     |        |    +---+----+    +--+--+--+
--     |        |    |   |    |    +--+--+--+
--     +--------+    +---+----+    +--+--+--+
--    ///////////                                     on a fixed base, nu = 0.3
--
-- Run        dygita run decks/verification/bonded_is_monolithic.lua
-- See        paraview out/bonded_is_monolithic/2x2x2/bonded_is_monolithic.pvd
-- Expect     largest difference of displacement (and velocity) over all common instants and 27 nodes, of the uncut body's
--            largest: 3.7e-8 at tolerance 1e-10 (goal 1e-6); 3.6e-4 for 36 pieces at tolerance 1e-6; static step first, then 40 steps at CFL 1
-- Read next  orders.lua

local p = param{ tolerance = 1e-10, iterations = 1000 }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local side, height, cells = 6*mm, 12*mm, { 6, 6, 12 }
local dt = 1*mm / math.sqrt(210*GPa * 1.35 / 7800)

-- Histories at 3 x 3 x 3 nodes; pieces are bricks i, j, k of nx x ny x nz.
local function block(nx, ny, nz)
  local parts, ties, top, bottom = {}, {}, {}, {}
  local function at(i, j, k) return parts[((i - 1) * ny + j - 1) * nz + k] end
  for i = 1, nx do for j = 1, ny do for k = 1, nz do
    local size = { side / nx, side / ny, height / nz }
    parts[#parts + 1] = substructure{
      name = ("piece_%d_%d_%d"):format(i, j, k), material = steel,
      mesh = mesh.box{
        origin = { (i-1) * size[1], (j-1) * size[2], (k-1) * size[3] }, size = size,
        cells = { cells[1] // nx, cells[2] // ny, cells[3] // nz },
      },
    }
  end end end
  local function tie(a, face_a, b, face_b)
    ties[#ties + 1] = interface.bonded{ name = "tie" .. #ties, between = { a:face(face_a), b:face(face_b) } }
  end
  for i = 1, nx do for j = 1, ny do for k = 1, nz do
    if i < nx then tie(at(i, j, k), "xmax", at(i+1, j, k), "xmin") end
    if j < ny then tie(at(i, j, k), "ymax", at(i, j+1, k), "ymin") end
    if k < nz then tie(at(i, j, k), "zmax", at(i, j, k+1), "zmin") end
    if k == nz then top[#top + 1] = at(i, j, k):face "zmax" end
    if k == 1 then bottom[#bottom + 1] = at(i, j, k):face "zmin" end
  end end end
  local base = support.fixed{ name = "base", on = bottom }
  local lean = step.static{ name = "lean", loads = { load.traction{ on = top, x = 5*MPa, z = -10*MPa } } }
  local hit = step.dynamic{ name = "hit", after = lean, duration = 40 * dt, dt = dt,
    loads = { load.pressure{ on = top, history = history.haversine{ peak = 80*MPa, duration = 20 * dt } } } }
  local outputs, probes = { output.energy{} }, {}
  for a = 0, 2 do for b = 0, 2 do for c = 0, 2 do
    local x0, y0, z0 = a * side / 2, b * side / 2, (c + 1) * height / 3
    local function here(x, y, z) return near(x, x0) and near(y, y0) and near(z, z0) end
    -- The node belongs to several pieces: the piece that has it and comes first.
    local i = math.min(nx, math.max(1, math.ceil(x0 / side * nx - 1e-9)))
    local j = math.min(ny, math.max(1, math.ceil(y0 / side * ny - 1e-9)))
    local k = math.min(nz, math.max(1, math.ceil(z0 / height * nz - 1e-9)))
    local on = at(i, j, k):where(here)
    for _, quantity in ipairs{ "displacement", "velocity" } do
      local probe = output.history{ name = ("%s_%d%d%d"):format(quantity, a, b, c), on = on, quantity = quantity }
      outputs[#outputs + 1] = probe
      probes[#probes + 1] = { probe = probe, quantity = quantity }
    end
  end end end
  local result = problem{
    name = "bonded_is_monolithic", substructures = parts, interfaces = ties, supports = { base }, steps = { lean, hit },
    solver = solver.latin{ integration = "implicit", tolerance = p.tolerance, static_tolerance = p.tolerance, max_iterations = p.iterations }, outputs = outputs,
  }:run{ case = ("%dx%dx%d"):format(nx, ny, nz) }
  local values = {}
  for i, probe in ipairs(probes) do values[i] = { quantity = probe.quantity, data = result[probe.probe] } end
  return values
end

local uncut = block(1, 1, 1)
local function compare(nx, ny, nz)
  local cut = block(nx, ny, nz)
  local off, scale = { displacement = 0, velocity = 0 }, { displacement = 0, velocity = 0 }
  for i, probe in ipairs(uncut) do
    for _, axis in ipairs{ "x", "y", "z" } do
      local a, b = probe.data[axis], cut[i].data[axis]
      for row = 1, #a do
        off[probe.quantity] = math.max(off[probe.quantity], math.abs(a[row] - b[row]))
        scale[probe.quantity] = math.max(scale[probe.quantity], math.abs(a[row]))
      end
    end
  end
  print(("%dx%dx%d pieces, max difference of the largest:%18.3e, velocity %.3e"):format(
    nx, ny, nz, off.displacement / scale.displacement, off.velocity / scale.velocity))
end
compare(1, 1, 2)
compare(2, 2, 2)
compare(3, 3, 4)
