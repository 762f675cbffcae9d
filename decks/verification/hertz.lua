-- hertz.lua -- a steel ball pressed on a steel block whose mesh is another: Hertz's contact radius and peak pressure.
--
--            F                      a quarter: planes of symmetry x = 0 and y = 0
--        ----v----                  the lower half of the ball, pressed on its equator
--       |  ball   |
--        \       /
--     ----`-...-'----
--    |   ->|a|<-     |              the block is 12 a wide and deep, fixed below
--    |     block     |
--
-- Run        dygita run decks/verification/hertz.lua            --set n=12    --set ratio=0.7
-- See        out/hertz/base/interfaces.pvd                      colour by pressure
-- Expect     radius within 0.5 % and peak pressure within 2 % of Hertz's at n = 6 cells on the radius; n = 4, 6, 8, 12: radius 0.5, 0.25,
--            0.16, 0.08 % too large, peak 1.3, 0.6, 0.3, 0.2 % too low
-- Read next  mindlin.lua shears it, hertz_cylinder.lua
-- Mesh       meshes/ball_on_block.geo: the ball and the block, tetrahedra of order 2, size a / n and ratio a / n at the contact

local p = param{ n = 6, ratio = 1.3, order = 2, growth = 0.4, friction = 0, increments = 1 }

local E, nu = 210*GPa, 0.3
local steel = material.elastic{ name = "steel", young = E, poisson = nu, density = 7800 }
local R, a = 10*mm, 0.5*mm
local function body(i, name, size)
  local set = { body = i, radius = R, contact = a, fine = size, growth = p.growth, wide = 12 * a }
  local file = mesh.gmsh{ file = "../../meshes/ball_on_block.geo", order = p.order, set = set }
  return substructure{ name = name, mesh = file:volume(name), material = steel }
end
local ball, block = body(1, "ball", a / p.n), body(2, "block", p.ratio * a / p.n)

local pole = ball:face{ where = function(x, y, z)      -- of the sphere what may come into contact
  return x^2 + y^2 < (2 * a)^2 and z < R / 2 and math.abs(math.sqrt(x^2 + y^2 + (z - R)^2) - R) < 1e-6 * R
end }
local contact = interface.contact{ name = "contact", between = { pole, block:face "top" }, friction = p.friction, gap = "geometry", within = 0.3 * a }
local symmetry = support.symmetry{ name = "symmetry", on = { ball:face "x", ball:face "y", block:face "x", block:face "y" } }
local floor = support.fixed{ name = "floor", on = block:face "bottom" }

local E_ = E / (1 - nu^2) / 2                          -- 1/E* of both
local F = 4 * E_ * a^3 / (3 * R)
local press = step.static{ name = "press", increments = p.increments, loads = { load.force{ on = ball:face "top", z = -F / 4 } } }
local footprint = output.footprint{ name = "footprint", on = contact, about = { 0, 0, 0 } }
local result = problem{
  name = "hertz", substructures = { ball, block }, interfaces = { contact }, supports = { symmetry, floor }, steps = { press },
  outputs = { footprint, output.joint{ name = "joint", on = contact }, output.vtk{ frames = 1 } },
}:run{}

local at = result[footprint]
local radius, peak = math.sqrt(2.5 * (at.spread_x.last^2 + at.spread_y.last^2)), 3 * F / (2 * math.pi * a^2)
print(("contact radius, error of Hertz's: %+.3f %% (%.4f of %.4f mm)"):format(100 * (radius / a - 1), radius / mm, a / mm))
print(("peak pressure, error of Hertz's: %+.3f %% (%.0f of %.0f MPa)"):format(100 * (at.pressure.last / peak - 1), at.pressure.last / MPa, peak / MPa))
print(("iterations in all: %d"):format(result.iterations))
