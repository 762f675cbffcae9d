-- orders.lua -- a smooth pulse runs along a bar; errors fall with the square of the cell and of the time step.
--
--         free |=====================|--> traction sin^4, for 0.6 T
--                      bar                                        T = L / c
--
-- Run        dygita run decks/verification/orders.lua             --set sizes=4
-- See        the table on screen
-- Expect     orders fitted between the two finest (theory 2, but 1 with numerical damping), L2 in space of the displacement
--            over 20 sections at 0.9 T, of the exact one's: h: hex8 1.97, prism6 1.97, tet4 1.95;
--            dt: 1.97; dt with damping: 0.99
-- Read next  spectrum.lua
-- Mesh       meshes/bar.geo for prisms and tetrahedra
--
-- Exact: u = 1 / (rho c) times the integral of the traction at t - (L - z) / c (nu = 0).

local p = param{ peak = 100*MPa, coarse = 40, fine_dt = 1000, fine_n = 640, sizes = 3 }

local E, rho, L, side = 200*GPa, 8000, 50*mm, 5*mm
local c = math.sqrt(E / rho)
local T = L / c
local D = 0.6 * T
local steel = material.elastic{ name = "steel", young = E, poisson = 0, density = rho }

local function traction(t) return t < D and p.peak * math.sin(math.pi * t / D)^4 or 0 end
local function exact(z, t)
  local tau = math.max(0, math.min(t - (L - z) / c, D))
  local w = math.pi / D
  return p.peak / (rho * c) * (3/8 * tau - math.sin(2 * w * tau) / (4 * w) + math.sin(4 * w * tau) / (32 * w))
end

local function slices(kind, n)
  if kind == "hex8" then return mesh.box{ size = { side, side, L }, cells = { 1, 1, n } } end
  return mesh.gmsh{ file = "../../meshes/bar.geo", set = { n = n, cells = kind == "prism6" and 1 or 0 } }:volume "bar"
end

-- L2 over the sections z = L/20, 2L/20, ... at 0.9 T.
local function distance(name, kind, n, steps, damping)
  local bar = substructure{ name = "bar", material = steel, mesh = slices(kind, n) }
  local pull = step.dynamic{
    name = "pull", duration = 0.9 * T, dt = 0.9 * T / steps, loads = { load.traction{ on = bar:face "zmax", z = traction } },
  }
  local sections = {}
  for k = 1, 20 do
    local here = bar:where(function(x, y, z) return near(z, k * L / 20) end)
    sections[k] = output.history{ name = "section_" .. k, on = here, quantity = "displacement", direction = { 0, 0, 1 } }
  end
  local result = problem{
    name = "orders", substructures = { bar }, steps = { pull }, outputs = sections,
    solver = solver.latin{ integration = "implicit", numerical_damping = damping },
  }:run{ case = name }
  local off, scale = 0, 0
  for k = 1, 20 do
    local u = exact(k * L / 20, 0.9 * T)
    off, scale = off + (result[sections[k]].last - u)^2, scale + u^2
  end
  return math.sqrt(off / scale)
end

local function series(name, kind, ns, steps, damping)
  local errors = {}
  local shown = {}
  for i = 1, p.sizes do
    errors[i] = distance(name .. "_" .. i, kind, ns(i), steps(i), damping)
    shown[i] = ("%.3e"):format(errors[i])
  end
  print(("%-22s errors %s   order: %.3f"):format(
    name, table.concat(shown, " "), math.log(errors[p.sizes - 1] / errors[p.sizes]) / math.log(2)))
end
local function always(value) return function() return value end end
local function from(value) return function(i) return math.floor(value * 2^(i - 1)) end end

local ns, short = from(p.coarse), always(p.fine_dt)
series("h_hex8", "hex8", ns, short, 0)
series("h_prism6", "prism6", ns, short, 0)
series("h_tet4", "tet4", ns, short, 0)
series("dt_undamped", "hex8", always(p.fine_n), from(30), 0)
series("dt_damped_0.2", "hex8", always(p.fine_n), from(120), 0.2)
