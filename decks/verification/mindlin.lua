-- mindlin.lua -- a ball pressed on a block and sheared: the outer ring of the contact slips, the middle sticks (Cattaneo, Mindlin).
--
--           u -> Q
--        ---------                  a half: plane of symmetry y = 0
--       |  ball   |  P              the ball's equator moves as one, down by d and then aside
--        \       /
--     ----`-...-'----
--    |    |-|c|-|    |              sticks within c, slips from there to a
--    |     block     |
--
-- Run        dygita run decks/verification/mindlin.lua          --set aside=0.8
-- See        out/mindlin/base/interfaces.pvd                    colour by state, pressure, slip
-- Expect     contact radius within 0.5 %, stick radius within 1 % of (1 - Q/(mu P))^(1/3) a
-- Read next  hertz.lua
-- Mesh       meshes/ball_on_block.geo: the ball and the block, tetrahedra of order 2, size a / n and ratio a / n at the contact

local p = param{ n = 6, ratio = 1.3, aside = 2, friction = 0.3, nu = 0, increments = 4 }

local E, nu, mu = 210*GPa, p.nu, p.friction
local steel = material.elastic{ name = "steel", young = E, poisson = nu, density = 7800 }
local R, a0 = 10*mm, 0.5*mm
local function body(i, name, size)
  local set = { body = i, half = 1, radius = R, contact = a0, fine = size, wide = 12 * a0 }
  local file = mesh.gmsh{ file = "../../meshes/ball_on_block.geo", order = 2, set = set }
  return substructure{ name = name, mesh = file:volume(name), material = steel }
end
local ball, block = body(1, "ball", a0 / p.n), body(2, "block", p.ratio * a0 / p.n)

local pole = ball:face{ where = function(x, y, z)
  return x^2 + y^2 < (2 * a0)^2 and z < R / 2 and math.abs(math.sqrt(x^2 + y^2 + (z - R)^2) - R) < 1e-6 * R
end }
local contact = interface.contact{ name = "contact", between = { pole, block:face "top" }, friction = mu, gap = "geometry", within = 0.3 * a0 }
local symmetry = support.symmetry{ name = "symmetry", on = { ball:face "y", block:face "y" } }
local floor = support.fixed{ name = "floor", on = block:face "bottom" }

local function move(x) return { load.displacement{ on = ball:face "top", x = x, z = -1.14 * a0^2 / R } } end
local press = step.static{ name = "press", loads = move(0) }
local shear = step.static{ name = "shear", after = press, increments = p.increments, loads = move(p.aside * 2*um) }
local footprint = output.footprint{ name = "footprint", on = contact, about = { 0, 0, 0 }, direction = { 1, 0, 0 } }
local force = output.resultant{ name = "force", on = contact }
local result = problem{
  name = "mindlin", substructures = { ball, block }, interfaces = { contact }, supports = { symmetry, floor }, steps = { press, shear },
  outputs = { footprint, force, output.joint{ name = "joint", on = contact }, output.vtk{ frames = 4 } },
}:run{}

-- Of the forces that were reached, those of the whole contact.
local P, Q = -2 * result[force].normal.last, 2 * math.abs(result[force].x.last)
local E_ = E / (1 - nu^2) / 2
local a = (3 * P * R / (4 * E_))^(1/3)
local at, share = result[footprint], Q / (mu * P)
local radius = math.sqrt(2.5 * (at.spread_x.last^2 + at.spread_y.last^2))
-- sum q r^2 / Q = 2/5 a^2 (1 - (c/a)^5) / (1 - (c/a)^3)
local reach = (at.shear_x.last^2 + at.shear_y.last^2) / (0.4 * a^2)
local low, high = 0, 1
for _ = 1, 60 do
  local c = (low + high) / 2
  if (1 - c^5) / (1 - c^3) < reach then low = c else high = c end
end
local c = (1 - share)^(1/3)
print(("Q / (mu P): %.4f, P = %.2f N"):format(share, P))
print(("contact radius, error of Hertz's: %+.3f %%"):format(100 * (radius / a - 1)))
print(("stick radius, error of Cattaneo's: %+.3f %% (%.4f of %.4f a)"):format(100 * (low / c - 1), low, c))
print(("iterations in all: %d"):format(result.iterations))
