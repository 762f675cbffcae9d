-- preload.lua -- a rod tightened in a sleeve to a force: the shortening that brings it is that of two springs.
--
--                      +------------------------+
--                      |          head          |     head and foot a hundred thousand times stiffer than the rod
--                      +------+--------+--------+ <-- contact, frictionless; may stand open by a gap at first
--                      |      |  rod   |        |
--                      | left |   ||   | right  |     the sleeve's two halves
--                      |      |   ||   |        |     nu = 0: nothing but lengths changes
--                      +------+--------+--------+ <-- contact, frictionless
--                      |          foot          |
--                      +------------------------+
--                     ///////////////////////////
--
-- Run        dygita run decks/verification/preload.lua
-- See        out/preload/*/bolts.csv
-- Expect     the force asked for, and the shortening d = F (1/k_r + 1/k_s) + plastic opening + gap, with the opening (F/A - R)/h of a
--            rod that yields at R and hardens by h. Forces, as asked for in four steps one after the other (half, all, nothing, all
--            again), by torque / (K diameter), through a yielding rod and through a gap, are right to 1e-8; the shortenings
--            differ from the exact ones by 1e-6 and less, the heads' own compliance. The last lines say what a search for the force
--            costs: iterations of the step that tightens, and of the same shortening prescribed
-- Read next  rod_in_sleeve.lua

local p = param{ force = 0.02, n = 4, rod = 20*MPa, sleeve = 7*MPa, head = 2000*GPa, gap = 10*um, tolerance = 1e-12, iterations = 2000 }

local l, depth, cap = 40*mm, 2*mm, 8*mm
local rod_metal    = material.elastic{ name = "rod metal",    young = p.rod,    poisson = 0, density = 1000 }
local sleeve_metal = material.elastic{ name = "sleeve metal", young = p.sleeve, poisson = 0, density = 1000 }
local head_metal   = material.elastic{ name = "head metal",   young = p.head,   poisson = 0, density = 1000 }
local function part(name, material_, from, width, z, height, cells)
  return substructure{
    name = name, material = material_,
    mesh = mesh.box{ origin = { from, 0, z }, size = { width, depth, height }, cells = { math.floor(width / mm + 0.5) // 2, 1, cells } },
  }
end
local rod   = part("rod", rod_metal, 4*mm, 2*mm, 0, l, p.n)
local left  = part("left", sleeve_metal, 0, 4*mm, 0, l, p.n)
local right = part("right", sleeve_metal, 6*mm, 4*mm, 0, l, p.n)
local head  = part("head", head_metal, 0, 10*mm, l, cap, 2)
local foot  = part("foot", head_metal, 0, 10*mm, -cap, cap, 2)
local thread = interface.bonded{ name = "thread", between = { foot:face "zmax", rod:face "zmin" } }
local base   = support.fixed{ name = "base", on = foot:face "zmin" }
local guides = support.symmetry{                 -- the halves slide: hold them sideways, not along z
  name = "guides", on = { left:face "xmin", left:face "ymin", right:face "xmax", right:face "ymin" },
}

-- The exact solution --------------------------------------------------------------------

local area = 2*mm * depth
local k_rod, k_sleeve = p.rod * area / l, p.sleeve * 8*mm * depth / l
local function shortening(force) return force * (1 / k_rod + 1 / k_sleeve) end
local F = p.force
local yield, hardening = 0.7 * F / area, 0.1 * p.rod / l

-- Cases ---------------------------------------------------------------------------------

local rod_moves  = output.history{ name = "rod",  on = rod:face "zmax",  quantity = "displacement", direction = { 0, 0, 1 } }
local head_moves = output.history{ name = "head", on = head:face "zmin", quantity = "displacement", direction = { 0, 0, 1 } }

-- Tightens `shank` by each load in turn; answers the result, the joint's output and the steps.
local function tighten(case, shank, gap, loads, more)
  local seats = {}
  for _, half in ipairs{ { "left", left }, { "right", right } } do
    seats[#seats + 1] = interface.contact{ name = half[1] .. "_foot", between = { foot:face "zmax", half[2]:face "zmin" }, friction = 0 }
    seats[#seats + 1] = interface.contact{ name = half[1] .. "_head", between = { half[2]:face "zmax", head:face "zmin" }, friction = 0, gap = gap }
  end
  local steps = {}
  for i, one in ipairs(loads) do
    steps[i] = step.static{ name = "tighten " .. i, after = steps[i - 1], increments = 2, loads = { one } }
  end
  if more then steps[#steps + 1] = more(steps[#steps]) end
  local joint = output.joint{ name = "joint", on = shank }
  local result = problem{
    name = "preload", substructures = { rod, left, right, head, foot },
    interfaces = { thread, shank, table.unpack(seats) }, supports = { base, guides }, steps = steps,
    solver = solver.latin{ static_tolerance = p.tolerance, max_iterations = p.iterations },
    outputs = { joint, rod_moves, head_moves, output.energy{} },
  }:run{ case = case }
  return result, joint, steps
end

local function say(what, value, unit) print(("%-58s %.3e %s"):format(what .. ":", value, unit or "")) end
local function found(result, at) return result[rod_moves]:at(at) - result[head_moves]:at(at) end
local function relative(value, exact) return math.abs(value / exact - 1) end
local function bonded() return interface.bonded{ name = "shank", between = { rod:face "zmax", head:face "zmin" } } end

local shank = bonded()
local asked = { 0.5 * F, F, 0, F }
local loads = {}
for i, force in ipairs(asked) do loads[i] = load.preload{ on = shank, force = force } end
local rest
local chain, joint, steps = tighten("chain", shank, 0, loads, function(last)
  local dt = l / p.n / math.sqrt(p.rod / 1000)
  rest = step.dynamic{ name = "rest", after = last, duration = 100 * dt, dt = dt }
  return rest
end)
for i, force in ipairs(asked) do
  say(("force asked for in step %d, error of F"):format(i), math.abs(chain[joint].normal:at(steps[i]) - force) / F)
  if force > 0 then say(("shortening found in step %d, error"):format(i), relative(found(chain, steps[i]), shortening(force))) end
end
say("force after 100 steps left alone, error", relative(chain[joint].normal.last, F))

local by_torque = bonded()
local turned, turned_joint = tighten("torque", by_torque, 0,
  { load.preload{ on = by_torque, torque = 4 * 0.2 * 2*mm * F, friction_factor = 0.2, diameter = 2*mm, share = 0.25 } })
say("force by torque on a quarter of a bolt, error", relative(turned[turned_joint].normal.last, F))

local weak = interface.plastic{ name = "shank", between = { rod:face "zmax", head:face "zmin" }, yield = yield, hardening = hardening }
local yielded, yielded_joint, yielded_steps = tighten("yields", weak, 0, { load.preload{ on = weak, force = F } })
local opening = (F / area - yield) / hardening
say("force through a rod that yields, error", relative(yielded[yielded_joint].normal.last, F))
say("its plastic opening, error", relative(yielded[yielded_joint].plastic_opening.last, opening))
say("its shortening less its opening, error",
  relative(found(yielded, yielded_steps[1]), shortening(F)))

local apart = bonded()
local closed, closed_joint, closed_steps = tighten("gap", apart, p.gap, { load.preload{ on = apart, force = F } })
say("force through a gap that closes, error", relative(closed[closed_joint].normal.last, F))
say("its shortening, error", relative(found(closed, closed_steps[1]), shortening(F) + p.gap))

-- The same shortening prescribed ----------------------------------------------------------

for _, case in ipairs{ { "bonded", bonded, 0, shortening(F) }, { "gap", bonded, p.gap, shortening(F) + p.gap },
                       { "yielding", function()
                         return interface.plastic{ name = "shank", between = { rod:face "zmax", head:face "zmin" }, yield = yield, hardening = hardening }
                       end, 0, shortening(F) + opening } } do
  local a, b = case[2](), case[2]()
  local by_force = tighten(case[1] .. " by force", a, case[3], { load.preload{ on = a, force = F } })
  local by_length = tighten(case[1] .. " by length", b, case[3], { load.shortening{ on = b, by = case[4] } })
  print(("iterations, %-44s %d by force, %d by length"):format(case[1] .. ":", by_force.iterations, by_length.iterations))
end
