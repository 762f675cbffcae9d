-- condensed_joint.lua -- a lap joint condensed: force against slip, loss per cycle and its exponent, for a system model.
--
--            clamped: an even pressure
--            v v v v v v v v v v v v v v v v
--            +-----------------------------+
--            |            cover            | --> F, to and fro
--            +=============================+   contact, friction: slides from both ends inwards
--        ///|            strap            |
--            +-----------------------------+   plane of symmetry (the other cover is the mirror image)
--
-- Run        dygita run decks/condensed_joint.lua                --set mu=0.1    --set press=5*MPa    --set least=0.05
-- See        out/condensed_joint/base/ends.csv                   force against displacement between the ends of the parts
--            out/condensed_joint/base/ends_cycles.csv            amplitude, stiffness, loss, local exponent of each cycle
--            out/condensed_joint/base/ends_backbone.csv          first loading, and the sliders of an Iwan model that has it
-- Expect     the joint slides gradually, from its two ends inwards: the loss grows with the force amplitude to the power 3.13 (Goodman's
--            exponent for thin parts under an even pressure is 3, and his loss is 1/3 F^3/(E A q): 13.6 mJ of 14.0 mJ at 960 N; mesh error 0.1 %, by n = 160, layers = 4). At small
--            forces the parts' thickness holds the ends: the exponent between the first two cycles is 3.49 at --set least=0.05. Measured
--            beams with bolted lap joints have local exponents from 2.2 to 3.1: no comparison of figures, their pressure is not even
-- Read next  condensed_flanges.lua

local p = param{ mu = 0.3, press = 10*MPa, height = 1*mm, least = 0.3, most = 0.8, n = 80, layers = 2, m = 12 }

local young = 70*GPa
local alloy = material.elastic{ name = "alloy", young = young, poisson = 0.3, density = 2700 }
local lap, width, height = 40*mm, 10*mm, p.height
local function plate(name, z)
  return substructure{
    name = name, material = alloy,
    mesh = mesh.box{ origin = { 0, 0, z }, size = { lap, width, height }, cells = { p.n, 1, p.layers } },
  }
end
local strap, cover = plate("strap", 0), plate("cover", height)
local mating = interface.contact{ name = "mating", between = { strap:face "zmax", cover:face "zmin" }, friction = p.mu }
local held   = support.fixed{ name = "held", on = strap:face "xmin" }
local middle = support.symmetry{ name = "middle", on = { strap:face "zmin", strap:face "ymin", cover:face "ymin" } }

-- To and fro at growing amplitudes: 0, A1, -A1, A2, -A2 ... and back to the last one.
local grip = p.mu * p.press * lap * width  -- beyond this force all of it slides
local points, times = { 0 }, {}
for i = 0, 5 do
  points[#points + 1] = (p.least + i / 5 * (p.most - p.least)) * grip
  points[#points + 1] = -points[#points]
end
points[#points + 1] = p.most * grip
for i = 1, #points do times[i] = (i - 1) / (#points - 1) end

local clamp = load.pressure{ on = cover:face "zmax", history = p.press }
local tighten = step.static{ name = "tighten", loads = { clamp } }
local cycle = step.static{
  name = "cycle", after = tighten, increments = p.m * (#points - 1),
  loads = { clamp, load.force{ on = cover:face "xmax", x = history.piecewise{ times = times, values = points } } },
}

local along = { 1, 0, 0 }
local ends  = output.loop{ name = "ends", on = mating, between = { strap:face "xmin", cover:face "xmax" }, direction = along, after = tighten }
local work  = output.joint{ name = "mating", on = mating }
local result = problem{
  name = "condensed_joint", substructures = { strap, cover }, interfaces = { mating }, supports = { held, middle },
  steps = { tighten, cycle }, outputs = { ends, work, output.energy{} },
}:run{}

print(("clamped with %.1f N; friction has taken %.4f mJ in all"):format(-result[work].normal:at(tighten), 1e3 * result[work].friction_work.last))
-- Goodman's loss: at each end half of F is brought over to the other part, and both parts stretch there.
local ea, q = young * width * height, p.mu * p.press * width
print("   force (N)   ends (um)   loss (mJ)   1/3 F^3/(E A q)   loss factor   local exponent")
local cycles = result[ends].cycles
for i = 1, #cycles.loss do
  local force = cycles.force_amplitude[i]
  print(("%12.1f %11.4f %11.5f %17.5f %13.4f %16.2f"):format(force, cycles.amplitude[i] / um, 1e3 * cycles.loss[i], 1e3 * force^3 / (3 * ea * q),
    cycles.loss_factor[i], cycles.exponent[i]))
end
print(("exponent of the loss over the force: %.2f; over the displacement: %.2f"):format(result[ends].exponent, result[ends].displacement_exponent))
