-- press_fit_rings.lua -- a ring pressed into another whose mesh is another: Lame's pressure.
--
--          | outer  \
--      ____|         \        quarter model, plane strain; radii 20, 30 and 40 mm, 10 um too large
--          | inner \  \       n_inner and n_outer facets a quarter where they meet: the facets of the two rings are
--      ____|__      \  \      up to 257 um (6 facets) apart, which is no gap
--             \      |  |
--
-- Run        dygita run decks/verification/press_fit_rings.lua           --set n_inner=4 --set n_outer=20
-- See        out/press_fit_rings/base/press_fit_rings.pvd              colour interfaces by pressure
-- Expect     mean pressure and displacement of the rim as Lame has them, but for the mesh's error: 0.9 % of the pressure
--            with 6 and 10 facets a quarter and 4 cells across a ring, a quarter of that with twice as many
-- Read next  unlike_patch.lua
-- Mesh       meshes/rings.geo: volumes inner and outer, meshed apart

local p = param{ n_inner = 6, n_outer = 10, n_radial = 4, interference = 10*um, order = 1 }

local E, nu = 210*GPa, 0.3
local steel = material.elastic{ name = "steel", young = E, poisson = nu, density = 7800 }
local rings = mesh.gmsh{ file = "../../meshes/rings.geo", set = { n_inner = p.n_inner, n_outer = p.n_outer, n_radial = p.n_radial } }
local inner = substructure{ name = "inner", mesh = rings:volume "inner", material = steel }
local outer = substructure{ name = "outer", mesh = rings:volume "outer", material = steel, place = { 0, 0, -10*mm } }
local between = { inner:face "outside", outer:face "inside" }
if p.order == 2 then between = { between[2], between[1] } end
local fit = interface.contact{ name = "fit", between = between, gap = -p.interference }
local symmetry = support.symmetry{ name = "symmetry", on = { inner:face "planes", inner:face "faces", outer:face "planes", outer:face "faces" } }
local press = step.static{ name = "press", increments = 1 }
local pressure = output.history{ name = "pressure", on = fit, quantity = "pressure" }
local footprint = output.footprint{ name = "footprint", on = fit }
local rim = output.history{ name = "rim", on = outer:where(function(x, y) return near(x, 40*mm) and near(y, 0) end), quantity = "displacement", direction = { 1, 0, 0 } }
local result = problem{
  name = "press_fit_rings", substructures = { inner, outer }, interfaces = { fit }, supports = { symmetry }, steps = { press },
  outputs = { pressure, footprint, rim, output.joint{ name = "joint", on = fit }, output.vtk{ frames = 1 } },
}:run{}

-- Lame, plane strain
local a, b, c = 20*mm, 30*mm, 40*mm
local E_, nu_ = E / (1 - nu^2), nu / (1 - nu)
local exact = p.interference / b * E_ / ((b^2 + a^2) / (b^2 - a^2) - nu_ + (c^2 + b^2) / (c^2 - b^2) + nu_)
local moved = 2 * exact * b^2 * c / (E_ * (c^2 - b^2))
print(("mean pressure, of Lame's: %.5f (%.3f MPa)"):format(result[pressure].last / exact, result[pressure].last / MPa))
print(("mean pressure, error of Lame's: %+.3f %%; oscillation of the pressure, largest over mean: %.3f %%"):format(
  100 * (result[pressure].last / exact - 1), 100 * (result[footprint].pressure.last / result[pressure].last - 1)))
print(("rim, error of Lame's: %+.3f %%"):format(100 * (result[rim].last / moved - 1)))
print(("rim moves, of Lame's: %.5f (%.4f um); %d iterations"):format(result[rim].last / moved, result[rim].last / um, result.iterations))
