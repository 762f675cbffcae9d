-- electronics_box.lua -- a box of electronics on a bracket: four bolts M6 tightened in a cross sequence, then a shock through the bracket.
--
--           +--------------------+                 4     3      seen from above: bolts 1 3 2 4 are tightened one after
--           |        box         |                              the other, each to 8 kN
--     [head]|                    |[head]           1     2
--    =washer+--------------------+washer=
--    +--||--------------------------||--+
--  //|  ||         bracket          ||  |//        the ends of the bracket are shaken upwards by a half-sine
--    +--||--------------------------||--+
--     [nut]                        [nut]
--
-- Run        dygita run decks/electronics_box.lua               --set force=6*kN    --set mu=0.2    --set around=3
-- See        out/electronics_box/base/report.html
-- Expect     each bolt at 8.00 kN when its turn comes and within 0.3 % of it after the shock; one warning, of the
--            coarse mesh (error 58 % of the shock's energy norm: --set around=6 --set layers=2 is finer)
-- Mesh       meshes/electronics_box.geo: volumes box bracket shank washer head nut
-- Read next  bolt_pattern.lua

local p = param{ force = 8*kN, mu = 0.15, around = 3, layers = 1, peak = 500, pulse = 0.5*ms, duration = 1*ms, dt = 5*us }
local peak, pulse, duration, dt = p.peak*g0, p.pulse, p.duration, p.dt  -- duration = 0: no shock

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local alloy = material.elastic{ name = "aluminium", young = 70*GPa, poisson = 0.33, density = 2700 }

local file = mesh.gmsh{ file = "../meshes/electronics_box.geo", set = { around = p.around, layers = p.layers } }
local box     = substructure{ name = "box", mesh = file:volume "box", material = alloy, place = { 0, 0, -100*mm } }
local bracket = substructure{ name = "bracket", mesh = file:volume "bracket", material = alloy, place = { 0, 0, -200*mm } }

local parts = { box, bracket }
local mating = interface.contact{ name = "mating", between = { bracket:face "upper", box:face "lower" }, friction = p.mu }
local interfaces, bolts = { mating }, {}
for i, at in ipairs{ { -40*mm, -25*mm }, { 40*mm, -25*mm }, { 40*mm, 25*mm }, { -40*mm, 25*mm } } do
  local function part(name, volume, z)
    local made = substructure{ name = name .. " " .. i, mesh = file:volume(volume), material = steel, place = { at[1], at[2], z } }
    table.insert(parts, made)
    return made
  end
  local shank, washer = part("shank", "shank", 0), part("washer", "washer", 5*mm - 300*mm)
  local head, nut = part("head", "head", 6.6*mm - 400*mm), part("nut", "nut", -15*mm - 500*mm)
  local function contact(name, a, b)
    table.insert(interfaces, interface.contact{ name = name .. " " .. i, between = { a, b }, friction = p.mu })
  end
  bolts[i] = interface.bonded{ name = "bolt " .. i, between = { shank:face "upper", head:face "lower" } }
  table.insert(interfaces, bolts[i])
  table.insert(interfaces, interface.bonded{ name = "thread " .. i, between = { nut:face "upper", shank:face "lower" } })
  contact("under head", washer:face "upper", head:face "lower")
  contact("washer", box:face "upper", washer:face "lower")
  contact("under nut", nut:face "upper", bracket:face "lower")
end
local ends = support.fixed{ name = "ends", on = bracket:face "ends" }

local steps, outputs = {}, { output.joint{ name = "mating", on = mating }, output.energy{} }
for _, i in ipairs{ 1, 3, 2, 4 } do
  table.insert(steps, step.static{ name = "bolt " .. i, after = steps[#steps], loads = { load.preload{ on = bolts[i], force = p.force } } })
end
if duration > 0 then
  local shake = load.base_acceleration{ on = ends, direction = { 0, 0, 1 }, history = history.half_sine{ peak = peak, duration = pulse } }
  table.insert(steps, step.dynamic{ name = "shock", after = steps[#steps], duration = duration, dt = dt, loads = { shake } })
  for name, face in pairs{ lid = box:face "lid", base = bracket:face "ends" } do
    local a = output.history{ name = name, on = face, quantity = "acceleration", direction = { 0, 0, 1 } }
    table.insert(outputs, a)
    table.insert(outputs, output.srs{ name = name .. "_srs", of = a, from = 1*kHz, to = 10*kHz })
  end
end
problem{ name = "electronics_box", substructures = parts, interfaces = interfaces, supports = { ends }, steps = steps, outputs = outputs }:run{}
