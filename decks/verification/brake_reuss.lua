-- brake_reuss.lua -- the Brake-Reuss beam: modes about its tightened joint, against published models and the measured beam.
--
--                          x = -60      60 mm
--    +-----------------------+--o---o---o--+                 720 x 25.4 x 25.4 mm, three bolts of 5/16 in, tightened to
--    |          top          |  |   |   |  |                 12 kN; free in space
--    |                       +--|---|---|--+-----------------------+
--    +-----------------------+  |   |   |          bot             |
--                            +--o---o---o--------------------------+
--
-- Run        dygita run decks/verification/brake_reuss.lua        --set push=50 --set only=6        --set push=50 --set spread=1
--            --set push=50 --set only=8 --set ring=0.1        --set push=30 --set only=8 --set cycle=1
-- See        out/brake_reuss/<case>/sticks.pvd                 the modes
-- Expect     the table of manual/measured-joints.md; the page says what agrees and what does not
-- Read next  modes of your own joint: manual/howto/modes.md
-- Mesh       meshes/brake_reuss.msh, made by meshes/make_brake_reuss.py; published data: see the page

local p = param{ fine = 0, only = 0, mu = 0.2, scale = 1, radius = 1.365*mm, density = 1.371e6, height = 28*um, force = 12249, push = 0, slip = 0.03, spread = 0, cycle = 0, ring = 0, dt = 100*us }

local file = mesh.gmsh{ file = p.fine == 1 and "../../meshes/brake_reuss_fine.msh" or "../../meshes/brake_reuss.msh" }
local asperities = { radius = p.radius, density = p.density, height = p.height }
-- Measured by profilometer: concave, 102.6 um in the middle.
local function measured(x) return p.scale * (102.6*um - 0.0253 * x^2) end

-- The first frequencies of bending in the plane of the bolts and across it.
local function beam(case)
  local steel = material.elastic{ name = "steel", young = case.young, poisson = case.poisson, density = case.mass }
  local function part(name) return substructure{ name = name, mesh = file:volume(name), material = steel } end
  local top, bot = part "top", part "bot"
  local shanks = {}
  for i = 1, 3 do shanks[i] = interface.bonded{ name = "shank " .. i, between = { top:face("mid" .. i), bot:face("mid" .. i) } } end
  local lap = interface.contact{ name = "lap", between = { top:face "lap", bot:face "lap" }, friction = case.mu, gap = case.form or 0,
    closed = not case.form, compliance = case.rough and { asperities = asperities } or nil }
  local tighten = step.static{ name = "tighten", increments = 3, loads = { load.preload{ on = shanks, force = case.force } } }
  local modes, joint = output.modes{ name = "sticks", n = 12, after = tighten }, output.joint{ name = "joint", on = lap }
  local steps, outputs, backbone = { tighten }, { modes, joint }, nil
  if case.push then
    local made = {}
    for i, value in ipairs(p.cycle == 1 and { case.push, -case.push, case.push } or { case.push }) do    -- a whole cycle: there, to the other side and back
      made[i] = step.static{ name = ({ "push", "pull", "back" })[i], after = steps[#steps], increments = i == 1 and 16 or 32,
        loads = { load.mode{ mode = modes, number = 7, parts = { top, bot }, value = value } } }
      steps[#steps + 1] = made[i]
    end
    backbone = output.backbone{ name = "backbone", mode = modes, number = 7, steps = made }
    outputs[3] = backbone
  end
  local tip, down
  if case.strike then    -- half a period, which sets the one mode in motion
    local blow = 0.5 / 168
    steps[2] = step.dynamic{ name = "ring", after = tighten, duration = p.ring, dt = p.dt,
      loads = { load.mode{ mode = modes, number = 7, parts = { top, bot }, value = history.half_sine{ peak = case.strike / 1.57, duration = blow } } } }
    tip = output.history{ name = "tip", on = top:where(function(x, y, z) return x < -359*mm end), quantity = "acceleration", direction = { 0, 0, 1 } }
    down = output.ringdown{ name = "down", of = tip, from = blow, band = { 100, 240 } }
    table.insert(outputs, tip)
    table.insert(outputs, down)
  end
  local result = problem{
    name = "brake_reuss", substructures = { top, bot }, interfaces = { lap, shanks }, steps = steps, outputs = outputs,
    solver = solver.latin{ static_steps = "assembled", anderson = case.strike and 20, search_direction = case.strike and 0.25 },    -- as soft as the beam is: a third fewer iterations
  }:run{ case = case.name, at = case.at }
  local line = {}
  for i = 7, 10 do line[i - 6] = ("%.2f"):format(result[modes].frequency[i]) end
  print(("%s (Hz): %s; open %.0f of %.0f mm^2"):format(case.name, table.concat(line, " "), result[joint].open_area.last / mm^2,
    (result[joint].open_area.last + result[joint].stick_area.last + result[joint].slip_area.last) / mm^2))
  local function list(amplitude, of)
    for i = 1, #amplitude do print(("  %6.2f m/s^2   %7.2f Hz   %.3f %%"):format(amplitude[i], of.frequency[i], 100 * of.damping[i])) end
  end
  if backbone then list(result[backbone].acceleration, result[backbone]) end
  if backbone and p.cycle == 1 then print(("  whole cycle: %.3f %%"):format(100 * result[backbone].cycle_damping)) end
  if down then list(result[down].amplitude, result[down]) end
end

-- As in the published model of the measured beam.
local function with(case)
  case.young, case.poisson, case.mass, case.mu, case.force = 192.31*GPa, 0.3, 7857.8, p.mu, p.force
  return case
end
local cases = {
  { name = "no friction, flat", young = 200*GPa, poisson = 0.29, mass = 7800, mu = 0, force = 12*kN },
  with{ name = "sticking, flat" },
  with{ name = "sticking, flat, rough", rough = true },
  with{ name = "sticking, measured form", form = measured },
  with{ name = "sticking, measured form, rough", form = measured, rough = true },
}
-- How frequency and damping go with the amplitude at the tips, up to `push` (m/s^2), with the published model's friction.
if p.push > 0 then
  cases[6] = with{ name = "backbone, flat" }
  cases[7] = with{ name = "backbone, measured form, rough", form = measured, rough = true }
  cases[8] = with{ name = "backbone, flat, rough", rough = true }
  for i = 6, 8 do cases[i].mu, cases[i].push = p.slip, p.push end
end
-- Torque, friction and form of one assembly and the next, one at a time and the two extremes of all; the same
-- with the published model's friction.
if p.spread > 0 then
  cases = {}
  for i, at in ipairs{ { 1, 0.2, 1 }, { 0.75, 0.2, 1 }, { 1.25, 0.2, 1 }, { 1, 0.1, 1 }, { 1, 0.3, 1 }, { 1, 0.2, 0.5 }, { 1, 0.2, 1.5 },
    { 0.75, 0.1, 0.5 }, { 1.25, 0.3, 1.5 }, { 1, p.slip, 1 }, { 0.75, p.slip, 1 }, { 1.25, p.slip, 1 }, { 1, p.slip, 0.5 }, { 1, p.slip, 1.5 } } do
    local torque, mu, form = at[1], at[2], at[3]
    cases[i] = with{ name = ("torque %.0f %%, friction %.2f, form %.1f"):format(100 * torque, mu, form), rough = true, push = p.push,
      form = function(x) return form * measured(x) end, at = { torque = torque, friction = mu, form = form } }
    cases[i].mu, cases[i].force = mu, torque * p.force
  end
end
for i, case in ipairs(cases) do
  if p.only == 0 or p.only == i then
    beam(case)
    if case.push and p.ring > 0 then    -- the same mode in time
      case.name, case.push, case.strike = case.name:gsub("backbone", "ring-down"), nil, 1.5 * case.push
      beam(case)
    end
  end
end
