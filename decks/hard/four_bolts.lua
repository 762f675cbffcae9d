-- four_bolts.lua -- two plates and four bolts, each with shank, head, washer and nut apart, tightened one after the other: many contacts between
--                   parts that only friction and each other hold, before their bolt is tightened.
--
--           +--------------------+                 4     3      seen from above: bolts 1 3 2 4 are tightened
--           |        box         |
--     [head]|                    |[head]           1     2
--    =washer+--------------------+washer=
--    +--||--------------------------||--+
--  //|  ||         bracket          ||  |//
--    +--||--------------------------||--+
--     [nut]                        [nut]
--
-- Run        dygita run decks/hard/four_bolts.lua              --set force=6*kN    --set mu=0.2    --set around=3
-- See        out/four_bolts/base/four_bolts.pvd
-- Expect     converges at the defaults, each bolt at 8.00 kN when its turn comes
-- Mesh       meshes/four_bolts.geo: volumes box bracket shank washer head nut
-- Read next  ../electronics_box.lua, which has a shock after it

local p = param{ force = 8*kN, mu = 0.15, around = 2, layers = 1 }

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local alloy = material.elastic{ name = "aluminium", young = 70*GPa, poisson = 0.33, density = 2700 }

local file = mesh.gmsh{ file = "../../meshes/four_bolts.geo", set = { around = p.around, layers = p.layers } }
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
problem{ name = "four_bolts", substructures = parts, interfaces = interfaces, supports = { ends }, steps = steps, outputs = outputs }:run{}
