-- board_shock.lua -- a record on the floor of a unit, and what its board makes of it: against a beam in closed form and a rule of thumb.
--
--        clamp ____                    ____ clamp                board 140 x 20 x 3 mm, 100 mm of it free; clamped by
--        board |__|____________________|__|                      pressure between standoffs and clamps, which friction holds
--     standoff |__|                    |__| standoff             standoffs bonded to the floor, which the record moves
--        =========================================  floor
--
-- Run        dygita run decks/verification/board_shock.lua         --set along=40 --set through=4
--            --set alone=1 (modes of the board by itself, held rigidly under its clamps)  --set alone=2 (at its edges)
-- See        out/board_shock/base/report.html: spectra, and the attenuation with the handbooks' rule as a line
-- Expect     the table of manual/measured-joints.md
-- Read next  a unit with boards: decks/electronics_box.lua
-- Record     decks/records/synthetic_shock.csv, made by make_synthetic_shock.py beside it; `dygita srs` prints its spectrum

local p = param{ along = 20, through = 2, mu = 0.3, press = 20*MPa, dt = 10*us, damping = 0.02, young = 70*GPa, alone = 0 }
local rho, length, width, thick, grip = 2700, 100*mm, 20*mm, 3*mm, 20*mm
local first = 22.3733 / (2*math.pi) * math.sqrt(p.young * thick^2 / 12 / rho) / length^2    -- Hz, of the clamped beam

local alloy = material.elastic{ name = "board", young = p.young, poisson = 0, density = rho, damping_ratio = p.damping, damping_frequency = first }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7800, damping_ratio = 0.01, damping_frequency = 10*kHz }
local n, m = math.tointeger(p.along), math.tointeger(p.through)
local function box(name, material, origin, size, cells) return substructure{ name = name, material = material, mesh = mesh.box{ origin = origin, size = size, cells = cells } } end
local grips = n // 5

if p.alone > 0 then
  local at_edges = p.alone == 2
  local part = substructure{ name = "board", material = alloy, mesh = mesh.box{ origin = { at_edges and grip or 0, 0, 0 },
    size = { at_edges and length or length + 2*grip, width, thick }, cells = { at_edges and n or n + 2*grips, 2, m } } }
  local ends = support.fixed{ name = "ends", on = part:where(function(x, y, z)
    return (at_edges or near(z, 0) or near(z, thick)) and (x < grip + 1e-7 or x > grip + length - 1e-7) end) }
  local modes = output.modes{ name = "modes", n = 1 }
  local result = problem{ name = "board_alone", substructures = { part }, supports = { ends }, outputs = { modes },
    steps = { step.static{ name = "rest", loads = { load.pressure{ on = part:face "zmax", history = 1 } } } } }:run{}
  print(("first mode (Hz): %.1f, beam %.1f"):format(result[modes].frequency[1], first))
  return
end

local board = box("board", alloy, { 0, 0, 0 }, { length + 2*grip, width, thick }, { n + 2*grips, 2, m })
local floor = box("floor", steel, { 0, 0, -16*mm }, { length + 2*grip, width, 6*mm }, { n + 2*grips, 2, 1 })
local parts, joints, pressed = { floor, board }, {}, {}
for i, x in ipairs{ 0, length + grip } do
  local standoff = box("standoff " .. i, steel, { x, 0, -10*mm }, { grip, width, 10*mm }, { grips, 2, 3 })
  local clamp = box("clamp " .. i, steel, { x, 0, thick }, { grip, width, 6*mm }, { grips, 2, 2 })
  table.insert(parts, standoff)
  table.insert(parts, clamp)
  local function under(part) return part:where(function(px, py, pz) return px > x - 1e-6 and px < x + grip + 1e-6 end) end
  table.insert(joints, interface.bonded{ name = "foot " .. i, between = { floor:face{ normal = { 0, 0, 1 }, at = -10*mm }, standoff:face "zmin" }, within = 1*um })
  table.insert(joints, interface.contact{ name = "seat " .. i, between = { standoff:face "zmax", board:face "zmin" }, friction = p.mu, within = 1*um })
  table.insert(joints, interface.contact{ name = "cap " .. i, between = { board:face "zmax", clamp:face "zmin" }, friction = p.mu, within = 1*um })
  pressed[i] = load.pressure{ on = clamp:face "zmax", history = p.press }
end

local record = history.file{ file = "../records/synthetic_shock.csv" }
local base = support.fixed{ name = "table", on = floor:face "zmin" }
local tighten = step.static{ name = "tighten", increments = 2, loads = pressed }
local shake = { pressed[1], pressed[2], load.base_acceleration{ on = base, direction = { 0, 0, 1 }, history = record } }
local shock = step.dynamic{ name = "shock", after = tighten, duration = 12*ms, dt = p.dt, loads = shake }

local function at(name, part, test) return output.history{ name = name, on = part:where(test), quantity = "acceleration", direction = { 0, 0, 1 } } end
local entering = at("floor", floor, function(x, y, z) return z < -15.9*mm and math.abs(x - 70*mm) < 4*mm end)
local middle = at("middle", board, function(x, y, z) return math.abs(x - 70*mm) < 0.1*mm end)
local band = { from = 200, to = 5*kHz }
local spectrum = output.srs{ name = "spectrum", of = middle, from = band.from, to = band.to, per_octave = 6 }
local input = output.srs{ name = "input", of = entering, from = band.from, to = band.to, per_octave = 6 }
local across = output.attenuation{ name = "to the board", entering = entering, leaving = middle, from = band.from, to = band.to }
local modes = output.modes{ name = "modes", n = 3, after = tighten }
local result = problem{ name = "board_shock", substructures = parts, interfaces = joints, supports = { base }, steps = { tighten, shock }, solver = solver.latin{ mass = "tuned" },
  outputs = { entering, middle, spectrum, input, across, modes } }:run{}

-- Acceleration of an oscillator against its base, exact for one that moves straight between samples: u'' + 2 zeta omega u' + omega^2 u = -a.
local h = p.dt
local function oscillator(base, omega, zeta)
  local x, v, wd, relative = 0, 0, omega * math.sqrt(1 - zeta^2), { [0] = -base[0] }
  local decay, c, s = math.exp(-zeta * omega * h), math.cos(wd * h), math.sin(wd * h)
  for i = 1, #base do
    local c1 = -(base[i] - base[i-1]) / h / omega^2
    local c0 = -base[i-1] / omega^2 - 2 * zeta * c1 / omega
    local A, B = x - c0, (v - c1 + zeta * omega * (x - c0)) / wd
    x = decay * (A * c + B * s) + c0 + c1 * h
    v = decay * ((wd * B - zeta * omega * A) * c - (wd * A + zeta * omega * B) * s) + c1
    relative[i] = -2 * zeta * omega * v - omega^2 * x - base[i]
  end
  return relative
end

-- The clamped beam under the same record: the middle of each symmetric mode, with its participation.
local input_record, beam = {}, {}
for i = 0, math.floor(12*ms / h + 0.5) do input_record[i] = record(i * h); beam[i] = input_record[i] end
for _, b in ipairs{ 4.730041, 10.995608, 17.278760 } do
  local sigma = (math.cosh(b) - math.cos(b)) / (math.sinh(b) - math.sin(b))
  local function phi(s) return math.cosh(b*s) - math.cos(b*s) - sigma * (math.sinh(b*s) - math.sin(b*s)) end
  local one, two, cells = 0, 0, 2000
  for i = 1, cells do
    local f = phi((i - 0.5) / cells)
    one, two = one + f, two + f * f
  end
  local times = (b / 4.730041)^2    -- the first frequency; damping is of the stiffness
  local relative = oscillator(input_record, 2*math.pi * first * times, p.damping * times)
  for i = 0, #relative do beam[i] = beam[i] + one / two * phi(0.5) * relative[i] end
end

local function largest(list, other)
  local most = 0
  for i = 1, #list do most = math.max(most, math.abs(list[i] + (other and other[i] or 0))) end
  return most
end
local sum, worst, n_bands = 0, 0, #result[spectrum].frequency
for i = 1, n_bands do
  local f = result[spectrum].frequency[i]
  local apart = 20 * math.log(result[spectrum].maximax[i] / largest(beam, oscillator(beam, 2*math.pi * f, 0.05)), 10)
  sum, worst = sum + math.abs(apart), math.abs(apart) > math.abs(worst) and apart or worst
end
print(("first mode (Hz): %.1f, beam %.1f"):format(result[modes].frequency[1], first))
print(("largest acceleration of the middle (g): %.0f, beam %.0f, floor %.0f"):format(largest(result[middle].acceleration) / g0, largest(beam) / g0, largest(input_record) / g0))
print(("spectrum of the middle beside the beam's (dB): %.2f on average, at most %.2f"):format(sum / n_bands, worst))
local ratio = result[across].ratio
local taken = 0
for i = 1, #ratio do taken = taken + ratio[i] / #ratio end
print(("attenuation (dB): %.1f on average, rule of thumb %.2f (%d bolted joints, %d bonds, %.3f m)"):format(taken, result[across].rule,
  result[across].joints, result[across].bonds, result[across].distance))
