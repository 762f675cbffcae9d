-- unlike_patch.lua -- a constant stress passes exactly through an interface whose meshes do not match.
--
--                pz                      z
--          v v v v v v                   |
--         +-----------+                  +-- x
--      -> |   upper   | <- px
--         +-----------+ <---- bonded, or contact (closed by pz; mu = 1 holds the shear, 29 of 50 MPa): other cells, or other nodes
--      -> |   lower   | <- px            below and above
--         +-----------+
--      held at x = y = z = 0 planes; or on six nodes' directions, for shear
--
-- Run        dygita run decks/verification/unlike_patch.lua
-- See        paraview out/unlike_patch/hex8_tet4_contact/unlike_patch.pvd        colour by stress: one colour
-- Expect     stress and displacement of the far corner exact for each pair of cells, in a static step and at rest in a
--            dynamic one after it (goal 1e-10)
-- Read next  patch.lua
-- Mesh       meshes/patch_hex8.msh, patch_prism6.msh, patch_tet4.msh: pushed about nodes; box: 3 x 3 x 2 cells

local p = param{ tolerance = 1e-13, iterations = 500, friction = 1 }

local E, nu = 70*GPa, 0.3
local alloy = material.elastic{ name = "alloy", young = E, poisson = nu, density = 2700 }
local px, py, pz = 30*MPa, 20*MPa, 50*MPa        -- pressures
local txy, tyz, tzx = 10*MPa, -15*MPa, 25*MPa    -- shear stresses
local solver_ = solver.latin{ static_tolerance = p.tolerance, tolerance = p.tolerance, max_iterations = p.iterations }
local dt = 0.2*us
local worst = 0

-- Errors over the largest pressure, of displacements over the largest displacement.
local function compare(name, result, stresses, exact_stress, corner, exact_corner, rest)
  local off, moved = 0, 0
  for i, output_ in ipairs(stresses) do
    for component, value in pairs(exact_stress) do
      for _, row in ipairs{ 1 + 1, #result[output_][component] } do
        off = math.max(off, math.abs(result[output_][component][row] - value) / pz)
      end
    end
  end
  local largest = math.max(math.abs(exact_corner.x), math.abs(exact_corner.y), math.abs(exact_corner.z))
  for axis, value in pairs(exact_corner) do
    moved = math.max(moved, math.abs(result[corner][axis].last - value) / largest)
  end
  worst = math.max(worst, off, moved)
  print(("%-58s %.3e  displacement %.3e"):format(name .. ", max error, stress:", off, moved))
end

local function body(kind, name)
  if kind ~= "box" then return mesh.gmsh{ file = "../../meshes/patch_" .. kind .. ".msh", unit = 10*mm }:volume(name) end
  return mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 3, 3, 2 }, origin = { 0, 0, name == "upper" and 10*mm or 0 } }
end

local function patch(below, above, joint, shear)
  local name = below .. "_" .. above .. "_" .. joint .. (shear and "_shear" or "")
  local lower = substructure{ name = "lower", mesh = body(below, "lower"), material = alloy }
  local upper = substructure{ name = "upper", mesh = body(above, "upper"), material = alloy }
  local between = { lower:face "zmax", upper:face "zmin" }
  local meeting = joint == "contact" and interface.contact{ name = "joint", between = between, friction = p.friction }
    or interface.bonded{ name = "joint", between = between }
  local a, h = 10*mm, 20*mm
  local function node(part, x0, y0, z0)
    return part:where(function(x, y, z) return near(x, x0) and near(y, y0) and near(z, z0) end)
  end
  local function both(face) return { lower:face(face), upper:face(face) } end
  local loads, supports = {}, {}
  local stress = { xx = -px, yy = -py, zz = -pz, xy = 0, yz = 0, zx = 0 }
  if shear then
    stress.xy, stress.yz, stress.zx = txy, tyz, tzx
    local function act(faces, nx, ny, nz)        -- traction = stress . normal
      loads[#loads + 1] = load.traction{ on = faces, x = stress.xx*nx + stress.xy*ny + stress.zx*nz,
        y = stress.xy*nx + stress.yy*ny + stress.yz*nz, z = stress.zx*nx + stress.yz*ny + stress.zz*nz }
    end
    act(both "xmin", -1, 0, 0)
    act(both "xmax", 1, 0, 0)
    act(both "ymin", 0, -1, 0)
    act(both "ymax", 0, 1, 0)
    act({ lower:face "zmin" }, 0, 0, -1)
    act({ upper:face "zmax" }, 0, 0, 1)
    -- Six directions, no more: u(0) = 0, v and w on the x axis, w on the y axis (the exact field below has them zero).
    loads[#loads + 1] = load.displacement{ on = node(lower, 0, 0, 0), x = 0, y = 0, z = 0 }
    loads[#loads + 1] = load.displacement{ on = node(lower, a, 0, 0), y = 0, z = 0 }
    loads[#loads + 1] = load.displacement{ on = node(lower, 0, a, 0), z = 0 }
  else
    loads = { load.pressure{ on = both "xmax", history = px }, load.pressure{ on = both "ymax", history = py },
      load.pressure{ on = upper:face "zmax", history = pz } }
    local planes = both "xmin"
    for _, face in ipairs(both "ymin") do planes[#planes + 1] = face end
    planes[#planes + 1] = lower:face "zmin"
    supports = { support.symmetry{ name = "planes", on = planes } }
  end
  local press = step.static{ name = "press", loads = loads }
  local rest = step.dynamic{ name = "rest", after = press, duration = 20 * dt, dt = dt, loads = loads }
  local corner = output.history{ name = "corner", on = node(upper, a, a, h), quantity = "displacement" }
  local motion = output.history{ name = "motion", on = node(upper, a, a, h), quantity = "velocity" }
  local stresses = {}
  for i, part in ipairs{ lower, upper } do
    stresses[i] = output.history{ name = "stress_" .. part.name, on = part:where(function() return true end), quantity = "stress" }
  end
  local result = problem{
    name = "unlike_patch", substructures = { lower, upper }, interfaces = { meeting }, supports = supports,
    steps = { press, rest }, solver = solver_,
    outputs = { corner, motion, stresses[1], stresses[2], output.vtk{ frames = 1 } },
  }:run{ case = name }
  local function strain(s, other, another) return (s - nu * (other + another)) / E end
  local g = E / (2 * (1 + nu))
  compare(name, result, stresses, stress, corner, {
    x = strain(stress.xx, stress.yy, stress.zz) * a + stress.xy / g * a + stress.zx / g * h,
    y = strain(stress.yy, stress.zz, stress.xx) * a + stress.yz / g * h,
    z = strain(stress.zz, stress.xx, stress.yy) * h,
  })
  local wave = math.sqrt(E / 2700) * pz / E
  print(("%-58s %.3e"):format(name .. ", velocity at rest of c x strain:", result[motion].max / wave))
end

for _, pair in ipairs{ { "hex8", "tet4" }, { "tet4", "prism6" }, { "prism6", "box" }, { "box", "hex8" }, { "tet4", "box" } } do
  for _, joint in ipairs{ "bonded", "contact" } do
    patch(pair[1], pair[2], joint, false)
    patch(pair[1], pair[2], joint, true)
  end
end
print(("%-58s %.3e"):format("largest error of all:", worst))
