-- impact.lua -- one oblique impact, and everything about it made extreme in turn.
--
--        \ 4 m/s aslant
--      +-----+
--      |punch|        stiffness, density, Poisson's ratio, aspect of the cells, friction, time step, search direction
--      +-----+  <---- contact, friction; touching, or one step away
--      |anvil|
--      +-----+
--     /////////       rigid wall, friction, unilateral
--
-- Run        dygita run decks/hard/impact.lua                 --set only=7 (one case of the list)      --set steps=1000
-- See        out/impact/<case>/run.json                       penetration, energies, iterations of a case
-- Expect     every case converges or says that it does not; no energy from nowhere (0.1 % at most), no penetration beyond
--            v dt / 2. 25 of the 28 converge in 3.4 to 65 iterations per step, none creates
--            energy, penetration is v dt / 2 of the first impact. NOT converged, and said: friction 1000 (2 steps of 120),
--            search directions 1e-3 and 1e3 (22 and 15 steps, indicator 1e-4 at worst). Three cells a body: an impact
--            costs 9 % of the energy, at CFL 100 75 %
-- Read next  grazing.lua

local p = param{ only = 0, steps = 120, n = 3, tolerance = 1e-6 }

local side, speed = 9*mm, 4
local base = { young = 70*GPa, density = 2700, poisson = 0.3, friction = 0.3, stiffer = 1, denser = 1, cfl = 1, aspect = 1,
               direction = 1, gap = 0 }
local cases = {
  { "plain" },
  { "friction_0", friction = 0 }, { "friction_1", friction = 1 }, { "friction_5", friction = 5 }, { "friction_1000", friction = 1000 },
  { "stiffer_1e2", stiffer = 1e2, young = 10*GPa }, { "stiffer_1e4", stiffer = 1e4, young = 100*MPa }, { "stiffer_1e6", stiffer = 1e6, young = 2*MPa },
  { "softer_1e6", stiffer = 1e-6, young = 2000*GPa },
  { "stiffer_1e6_cfl_100", stiffer = 1e6, young = 2*MPa, cfl = 100 },
  { "denser_50", denser = 50, density = 400 }, { "denser_2500", denser = 2500, density = 10 },
  { "lighter_2500", denser = 1/2500, density = 25000 },
  { "denser_1e4", denser = 1e4, density = 10 }, { "lighter_1e4", denser = 1e-4, density = 1e5 },
  { "cfl_0.1", cfl = 0.1 }, { "cfl_10", cfl = 10 }, { "cfl_100", cfl = 100 },
  { "poisson_0.49", poisson = 0.49 }, { "poisson_0.499", poisson = 0.499 }, { "poisson_0.4999", poisson = 0.4999 }, { "poisson_-0.8", poisson = -0.8 },
  { "aspect_flat_100", aspect = 0.01 }, { "aspect_long_100", aspect = 100 },
  { "direction_1e-3", direction = 1e-3 }, { "direction_1e3", direction = 1e3 },
  { "gap", gap = 0.5*um }, { "friction_1_gap_cfl_10", friction = 1, gap = 2*um, cfl = 10 },
}

local function impact(case)
  local name = case[1]
  local function of(key) return case[key] or base[key] end
  local h = side / p.n
  local height = h * of "aspect" * p.n
  local function metal(name_, times_e, times_rho)
    return material.elastic{ name = name_, young = of "young" * times_e, poisson = of "poisson", density = of "density" * times_rho }
  end
  local function speed_of(e, rho)                -- of a P wave
    local nu = of "poisson"
    return math.sqrt(e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / rho)
  end
  local function body(name_, from, metal_, velocity)
    return substructure{
      name = name_, material = metal_, velocity = velocity,
      mesh = mesh.box{ origin = { 0, 0, from }, size = { side, side, height }, cells = { p.n, p.n, p.n } },
    }
  end
  local anvil = body("anvil", 0, metal("anvil metal", 1, 1), { 0, 0, 0 })
  local punch = body("punch", height, metal("punch metal", of "stiffer", of "denser"), { 0.5 * speed, 0.25 * speed, -speed })
  local touch = interface.contact{
    name = "touch", between = { anvil:face "zmax", punch:face "zmin" }, friction = of "friction", gap = of "gap",
  }
  local floor = support.wall{ name = "floor", on = anvil:face "zmin", friction = of "friction" }
  local c = math.max(speed_of(of "young", of "density"), speed_of(of "young" * of "stiffer", of "density" * of "denser"))
  local dt = of "cfl" * math.min(h, height / p.n) / c
  local hit = step.dynamic{ name = "hit", duration = p.steps * dt, dt = dt }
  local grip, energy = output.joint{ name = "grip", on = touch }, output.energy{}
  local result = problem{
    name = "impact", substructures = { anvil, punch }, interfaces = { touch }, supports = { floor }, steps = { hit },
    solver = solver.latin{ search_direction = of "direction", tolerance = p.tolerance }, outputs = { grip, energy },
  }:run{ case = name }
  local start, created, friction = result[energy].kinetic.first, 0, result[grip].friction_work.last
  for i = 1, #result[energy].scheme do created = math.max(created, -result[energy].scheme[i]) end
  print(("%-24s %5.1f iterations, energy created %8.1e %%, lost %6.2f %%, friction %5.1f %%: %s"):format(
    name, result.mean_iterations, 100 * created / start, 100 * result[energy].scheme.last / start, 100 * friction / start,
    result.converged and "converged" or "NOT converged"))
end

for i, case in ipairs(cases) do
  if p.only == 0 or p.only == i then impact(case) end
end
