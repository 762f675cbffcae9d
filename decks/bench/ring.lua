-- ring.lua -- the separation ring without its preload: sectors of four bodies each, a charge that burns around. A scene for runs of several ranks.
--
--      upper --+-- upper --+--     sectors tied to the next ones, all around
--       |head  |    |head  |
--       |stud  |    |stud  |       stud and head tied, contact with friction between the halves and under the head
--      lower --+-- lower --+--
--
-- Run        mpirun -n 2 dygita run decks/bench/ring.lua          --set bolts=12 --set size=12*mm --set steps=20
-- See        ./run.sh bench ranks, the chapter manual/performance.md; run.json has under "ranks" who exchanges what with whom
-- Expect     every step converged; 4 bodies a sector
-- Read next  ../separation_ring.lua, which tightens its bolts

local p = param{ bolts = 24, size = 12*mm, steps = 20, dt = 1*us, mu = 0.2 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local alloy = material.elastic{ name = "alloy", young = 72*GPa, poisson = 0.33, density = 2800 }

local n = p.bolts
local function body(i, name, material_)
  local file = mesh.gmsh{ file = "../../meshes/separation_ring.geo", set = { body = i, size = p.size, bolts = n } }
  return pattern.circle{ n = n, axis = { 0, 0, 1 }, of = substructure{ name = name, mesh = file:volume(name), material = material_ } }
end
local upper, lower, stud, head = body(1, "upper", alloy), body(2, "lower", alloy), body(3, "stud", steel), body(4, "head", steel)

local parts, interfaces, ends, loads = {}, {}, {}, {}
local function join(interface_) table.insert(interfaces, interface_) end
for i = 1, n do
  for _, part in ipairs{ upper[i], lower[i], stud[i], head[i] } do table.insert(parts, part) end
  join(interface.contact{ name = "mating " .. i, between = { lower[i]:face "mating", upper[i]:face "mating" }, friction = p.mu })
  join(interface.contact{ name = "under head " .. i, between = { upper[i]:face "seat", head[i]:face "seat" }, friction = p.mu })
  join(interface.bonded{ name = "nut " .. i, between = { stud[i]:face "seat", lower[i]:face "seat" } })
  join(interface.bonded{ name = "bolt " .. i, between = { stud[i]:face "head_end", head[i]:face "stud_end" } })
  for _, ring in ipairs{ upper, lower } do
    table.insert(ends, ring[i]:face "end")
    join(interface.bonded{ name = ring[i].name .. " to the next", between = { ring[i]:face "right", ring[i % n + 1]:face "left" } })
  end
  local away = math.min(i - 1, n - (i - 1)) * 2 * math.pi / n * 0.498     -- m
  table.insert(loads, load.pressure{ on = upper[i]:face "band", history = history.half_sine{ peak = 10*MPa, duration = 20*us }:shifted(away / 7000) })
end
local result = problem{
  name = "ring", substructures = parts, interfaces = interfaces, supports = { support.absorbing{ name = "ends", on = ends } },
  steps = { step.dynamic{ name = "shock", duration = p.steps * p.dt, dt = p.dt, loads = loads } }, outputs = { output.energy{} },
}:run{}
print(("%d bodies, %.1f iterations per step: %s"):format(#parts, result.mean_iterations, result.converged and "converged" or "NOT converged"))
