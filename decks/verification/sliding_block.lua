-- sliding_block.lua -- a block thrown along a rough wall stops; on an incline it stays below the angle of friction.
--
--      +-------+  --> v                     incline: gravity leans by an angle
--      | block |        gravity             tan < mu: it stays       tan > mu: it goes with g (sin - mu cos)
--      +-------+        v
--     ///////////////////////  mu
--
-- Run        dygita run decks/verification/sliding_block.lua         --set mu=0.3
-- See        paraview out/sliding_block/thrown/sliding_block.pvd     colour by velocity x
-- Expect     settled under its weight first, thrown at 0.5 m/s it stops after v^2 / (2 mu g) within 0.001 %; on an incline of
--            0.9 mu it leans elastically, 0.003 % of the way without friction; of 1.2 mu it slides g (sin - mu cos) t^2 / 2
--            within 0.4 % (its sole sticks until the shear has come down)
-- Read next  patch.lua

local p = param{ mu = 0.5, n = 2, g = 1000, velocity = 0.5, dt = 1*us }

local side, height = 20*mm, 10*mm
local steel = material.elastic{ name = "steel", young = 100*GPa, poisson = 0, density = 1000 }

local function say(what, value, unit) print(("%-58s %.4g %s"):format(what .. ":", value, unit)) end

-- Moves for `duration` under gravity that leans by `angle`; the weight is there from the static step on.
local function slide(name, velocity, angle, duration)
  local block = substructure{
    name = "block", material = steel, velocity = { velocity, 0, 0 },
    mesh = mesh.box{ size = { side, side, height }, cells = { p.n, p.n, math.max(1, p.n // 2) } },
  }
  local floor = support.wall{ name = "floor", on = block:face "zmin", friction = p.mu }
  local guide = support.symmetry{ name = "guide", on = block:face "ymin" }
  local weight = load.gravity{ z = -p.g * math.cos(angle), x = p.g * math.sin(angle) }
  local settle = step.static{ name = "settle", loads = { load.gravity{ z = -p.g * math.cos(angle) } } }
  local go = step.dynamic{ name = "go", after = settle, duration = duration, dt = p.dt, loads = { weight } }
  local way = output.history{ name = "way", on = block:face "zmin", quantity = "displacement", direction = { 1, 0, 0 } }
  local sole = output.joint{ name = "sole", on = floor }
  local result = problem{
    name = "sliding_block", substructures = { block }, supports = { floor, guide }, steps = { settle, go },
    outputs = { way, sole, output.energy{}, output.vtk{ frames = 20 } },
  }:run{ case = name }
  return result[way].last, result[sole].friction_work.last
end

local stop = p.velocity / (p.mu * p.g)           -- seconds
local distance, heat = slide("thrown", p.velocity, 0, 1.5 * stop)
local mass = 1000 * side^2 * height
say("thrown: distance of v^2 / (2 mu g), error", 100 * (distance / (p.velocity^2 / (2 * p.mu * p.g)) - 1), "%")
say("thrown: work of friction of the kinetic energy, error", 100 * (heat / (mass * p.velocity^2 / 2) - 1), "%")

local t = 1*ms
local shallow, steep = math.atan(0.9 * p.mu), math.atan(1.2 * p.mu)
local crept = slide("shallow", 0, shallow, t)
say("shallow: way of what it would be without friction", 100 * crept / (p.g * math.sin(shallow) * t^2 / 2), "%")
local slid = slide("steep", 0, steep, t)
say("steep: way of g (sin - mu cos) t^2 / 2, error", 100 * (slid / (p.g * (math.sin(steep) - p.mu * math.cos(steep)) * t^2 / 2) - 1), "%")
