-- spectrum.lua -- a base shaken by half a sine, 1 g and 11 ms: the shock response spectrum of the textbook.
--
--      +-------+
--      | block |
--      +-------+
--     /////////// --> a(t)     half-sine
--
-- Run        dygita run decks/verification/spectrum.lua              --set dt=0.01*ms
-- See        out/spectrum/base/srs.csv
-- Expect     maximax absolute acceleration at Q = 10 within 0.02 % of the exact one at 10, 20, 40, 80 ... 1000 Hz
--            (0.4052, 0.7831, 1.3615, 1.6483, ... g), peak 1.65 g between 65 and 85 Hz
-- Read next  ../hard/friction.lua
--
-- Exact: the oscillator's response to the half-sine in closed form, looked at 2000 instants a period and pulse.

local p = param{ dt = 0.05*ms, q_factor = 10 }

local D = 11*ms
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 8000 }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 5*mm, 5*mm, 5*mm }, cells = { 1, 1, 1 } } }
local base = support.fixed{ name = "base", on = block:face "zmin" }
local shake = step.dynamic{
  name = "shake", duration = 250*ms, dt = p.dt,
  loads = { load.base_acceleration{ on = base, direction = { 1, 0, 0 }, history = history.half_sine{ peak = g0, duration = D } } },
}
local table_ = output.history{ name = "table", on = block:face "zmin", quantity = "acceleration", direction = { 1, 0, 0 } }
local srs = output.srs{ name = "srs", of = table_, q_factor = p.q_factor, from = 10, to = 1000, per_octave = 4 }
local result = problem{
  name = "spectrum", substructures = { block }, supports = { base }, steps = { shake }, outputs = { table_, srs },
}:run{}

-- Absolute acceleration of the oscillator: x'' + 2 z wn (x' - y') + wn^2 (x - y) = 0, relative motion in closed form.
local function exact(f)
  local wn, w, zeta = 2 * math.pi * f, math.pi / D, 1 / (2 * p.q_factor)
  local wd = wn * math.sqrt(1 - zeta^2)
  -- Steady part of r'' + 2 zeta wn r' + wn^2 r = -sin(w t): A sin + B cos.
  local k, d = wn^2 - w^2, 2 * zeta * wn * w
  local A, B = -k / (k^2 + d^2), d / (k^2 + d^2)
  local function relative(t)                     -- r and r' during the pulse
    local C, e = -B, math.exp(-zeta * wn * t)
    local S = (-A * w + zeta * wn * C) / wd
    local co, si = math.cos(wd * t), math.sin(wd * t)
    return A * math.sin(w * t) + B * math.cos(w * t) + e * (C * co + S * si),
      A * w * math.cos(w * t) - B * w * math.sin(w * t) + e * ((S * wd - zeta * wn * C) * co - (C * wd + zeta * wn * S) * si)
  end
  local r0, v0 = relative(D)
  local largest = 0
  local function look(r, v) largest = math.max(largest, math.abs(2 * zeta * wn * v + wn^2 * r)) end
  for i = 0, 2000 do look(relative(D * i / 2000)) end
  for i = 0, 2000 do                             -- free from then on
    local t = i / 2000 / f
    local e, co, si = math.exp(-zeta * wn * t), math.cos(wd * t), math.sin(wd * t)
    local S = (v0 + zeta * wn * r0) / wd
    look(e * (r0 * co + S * si), e * ((S * wd - zeta * wn * r0) * co - (r0 * wd + zeta * wn * S) * si))
  end
  return largest
end

local off, peak, at = 0, 0, 0
for i = 1, #result[srs].maximax do
  local f, got = result[srs].frequency[i], result[srs].maximax[i] / g0
  off = math.max(off, math.abs(got / exact(f) - 1))
  if got > peak then peak, at = got, f end
end
local function say(what, value, unit) print(("%-58s %.4g %s"):format(what .. ":", value, unit)) end
for _, f in ipairs{ 10, 20, 40, 80 } do say("exact at " .. f .. " Hz", exact(f), "g") end
say("maximax over the spectrum, max error", 100 * off, "%")
say("peak", peak, "g")
say("frequency of the peak", at, "Hz")
