-- rod_in_sleeve.lua -- a rod tightened in a sleeve is two springs: force, share of a pull, opening, and coming back.
--
--      ^ pull P        +------------------------+
--      |               |          head          |     head and foot a hundred thousand times stiffer than the rod
--                      +------+--------+--------+ <-- contact, frictionless
--                      |      |  rod   |        |
--                      | left |   ||   | right  |     the sleeve's two halves
--                      |      |   ||   |        |     nu = 0: nothing but lengths changes
--                      +------+--------+--------+ <-- contact, frictionless
--                      |          foot          |
--                      +------------------------+
--                     ///////////////////////////
--
-- Run        dygita run decks/verification/rod_in_sleeve.lua
-- See        paraview out/rod_in_sleeve/base/rod_in_sleeve.pvd      warp x100
-- Expect     shortened by d the rod carries F = d / (1/k_r + 1/k_s); under 0.8 of the separation load F (1 + k_r / k_s) it carries
--            F + P k_r / (k_r + k_s), under 1.5 of it all of P, and then F again; left alone for 200 steps it stays at rest.
--            Measured, in this order: 4.6e-7, 3.8e-7, 1e-9 and 4.8e-7 off; at rest within 1e-11 of wave speed times
--            strain. What is left is the heads. At --set tolerance=1e-10 the last is 2.4e-6: stiff heads
--            weigh most in the indicator
-- Read next  sliding_block.lua

local p = param{ shorten = 20*um, n = 4, rod = 20*MPa, sleeve = 7*MPa, head = 2000*GPa, tolerance = 1e-12, iterations = 2000 }

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
local shank  = interface.bonded{ name = "shank", between = { rod:face "zmax", head:face "zmin" } }
local seats  = {
  interface.contact{ name = "left_foot",  between = { foot:face "zmax", left:face "zmin" }, friction = 0 },
  interface.contact{ name = "left_head",  between = { left:face "zmax", head:face "zmin" }, friction = 0 },
  interface.contact{ name = "right_foot", between = { foot:face "zmax", right:face "zmin" }, friction = 0 },
  interface.contact{ name = "right_head", between = { right:face "zmax", head:face "zmin" }, friction = 0 },
}
local base   = support.fixed{ name = "base", on = foot:face "zmin" }
local guides = support.symmetry{                 -- the halves slide: hold them sideways, not along z
  name = "guides", on = { left:face "xmin", left:face "ymin", right:face "xmax", right:face "ymin" },
}

-- The exact solution --------------------------------------------------------------------

local k_rod, k_sleeve = p.rod * 2*mm * depth / l, p.sleeve * 8*mm * depth / l
local F = p.shorten / (1 / k_rod + 1 / k_sleeve)
local separation = F * (1 + k_rod / k_sleeve)

local tighten = step.static{ name = "tighten", increments = 2, loads = { load.shortening{ on = shank, by = p.shorten } } }
local function pull(name, after, force)
  return step.static{ name = name, after = after, increments = 2, loads = { load.force{ on = head:face "zmax", z = force } } }
end
local below  = pull("below", tighten, 0.8 * separation)
local beyond = pull("beyond", below, 1.5 * separation)
local back   = pull("back", beyond, 0)
local dt = l / p.n / math.sqrt(p.rod / 1000)
local rest   = step.dynamic{ name = "rest", after = back, duration = 200 * dt, dt = dt }

local bolt, motion = output.resultant{ name = "bolt", on = shank },
  output.history{ name = "motion", on = rod:face "zmax", quantity = "velocity" }
local seat = output.joint{ name = "seat", on = seats[2] }
local clamp = problem{
  name = "rod_in_sleeve", substructures = { rod, left, right, head, foot },
  interfaces = { thread, shank, table.unpack(seats) }, supports = { base, guides },
  steps = { tighten, below, beyond, back, rest },
  solver = solver.latin{ static_tolerance = p.tolerance, max_iterations = p.iterations },
  outputs = { bolt, seat, motion, output.energy{}, output.vtk{ frames = 4 } },
}
local result = clamp:run{}

local function say(what, value, unit) print(("%-58s %.3e %s"):format(what .. ":", value, unit)) end
local function check(what, at, exact) say(what, math.abs(result[bolt].normal:at(at) / exact - 1), "") end
check("force tightened, error", tighten, F)
check("share of a pull below separation, error", below, F + 0.8 * separation * k_rod / (k_rod + k_sleeve))
check("all of a pull beyond separation, error", beyond, 1.5 * separation)
check("force after the pull, error", back, F)
say("open area beyond separation, of all", result[seat].open_area:at(beyond) / (4*mm * depth), "")
say("velocity left alone, of wave speed times strain",
    result[motion].max / (math.sqrt(p.rod / 1000) * F / (p.rod * 2*mm * depth)), "")
