-- hertz_cylinder.lua -- a cylinder pressed on a block whose mesh is another, in plane strain: Hertz's half width and peak pressure.
--
--            P a length             the half x > 0, one cell thick, its ends on planes of symmetry
--         ----v----
--        | cylinder|
--     ----`-..|..-'----
--    |     block       |            20 mm wide and deep, 40 half widths, fixed below
--
-- Run        dygita run decks/verification/hertz_cylinder.lua        --set n=24   --set order=2
-- See        out/hertz_cylinder/base/interfaces.pvd                  colour by pressure
-- Expect     half width within 0.5 % and peak pressure within 2 % of Hertz's from n = 12 cells on the half width on; n = 6, 12, 24:
--            half width 1.2, 0.2, 0.0 % too large, peak off by -0.6, -0.1, 0.0 %
-- Read next  pin_in_hole.lua, where the contact is no longer small
-- Mesh       meshes/cylinder_on_block.geo: hexahedra (quadratic with order = 2), size a / n and ratio a / n at the contact

local p = param{ n = 12, ratio = 1.3, order = 1, growth = 0.2, wide = 20*mm }

local E, nu = 210*GPa, 0.3
local steel = material.elastic{ name = "steel", young = E, poisson = nu, density = 7800 }
local R, a = 10*mm, 0.5*mm
local thick = a / 5
local function body(i, name, size)
  local set = { body = i, radius = R, contact = a, fine = size, growth = p.growth, wide = p.wide, thick = thick }
  local file = mesh.gmsh{ file = "../../meshes/cylinder_on_block.geo", order = p.order, set = set }
  return substructure{ name = name, mesh = file:volume(name), material = steel }
end
local cylinder, block = body(1, "cylinder", a / p.n), body(2, "block", p.ratio * a / p.n)

local line = cylinder:face{ where = function(x, y, z)  -- of the cylinder what may come into contact
  return x < 2 * a and z < R / 2 and math.abs(math.sqrt(x^2 + (z - R)^2) - R) < 1e-6 * R
end }
local contact = interface.contact{ name = "contact", between = { line, block:face "top" }, gap = "geometry", within = 0.3 * a }
local symmetry = support.symmetry{ name = "symmetry", on = { cylinder:face "x", cylinder:face "ends", block:face "x", block:face "ends" } }
local floor = support.fixed{ name = "floor", on = block:face "bottom" }

local E_ = E / (1 - nu^2) / 2                          -- 1/E* of both
local P = math.pi * E_ * a^2 / (4 * R)                 -- N/m
local press = step.static{ name = "press", loads = { load.force{ on = cylinder:face "top", z = -P * thick / 2 } } }
local footprint = output.footprint{ name = "footprint", on = contact, about = { 0, 0, 0 } }
local result = problem{
  name = "hertz_cylinder", substructures = { cylinder, block }, interfaces = { contact }, supports = { symmetry, floor }, steps = { press },
  outputs = { footprint, output.joint{ name = "joint", on = contact }, output.vtk{ frames = 1 } },
}:run{}

local at = result[footprint]
local half, peak = 2 * at.spread_x.last, 2 * P / (math.pi * a)
print(("half width, error of Hertz's: %+.3f %% (%.4f of %.4f mm)"):format(100 * (half / a - 1), half / mm, a / mm))
print(("peak pressure, error of Hertz's: %+.3f %% (%.0f of %.0f MPa)"):format(100 * (at.pressure.last / peak - 1), at.pressure.last / MPa, peak / MPa))
print(("iterations in all: %d"):format(result.iterations))
