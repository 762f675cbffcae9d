-- goodman.lua -- a bar pressed evenly on a rigid, rough ground and pulled to and fro: Goodman's joint, whose loss is known.
--
--        p p p p p p p p p p p p p p p p         (half of the bar: the other half is its mirror image)
--      +---------------------------------+  ---- plane of symmetry
--  F <-|  slides  |        sticks        |  h
--  --> +---------------------------------+
--     ///////////////////////////////////  mu
--
-- Run        dygita run decks/verification/goodman.lua                --set n=400 --set m=40
-- See        out/goodman/base/bar.csv  bar_cycles.csv  bar_backbone.csv
-- Expect     with q = mu p w the force that friction can take a metre, a pull F slides a length F/q of the bar, its end moves by
--            F^2 / (2 E A q), and a cycle between -F and F loses 2/3 F^3 / (E A q) (manual, eq. C8-C10): the exponent of the
--            loss is 3 over the force and 1.5 over the displacement. Measured: 3.002 and 1.501, the loss within 0.66 %, of the
--            largest cycle 0.26 % (the trapezoid around the loop: 1/m^2)
-- Read next  ../condensed_joint.lua

local p = param{ mu = 0.2, press = 10*MPa, n = 200, m = 20, height = 0.5*mm }

local length, width, young = 100*mm, 10*mm, 70*GPa
local alloy = material.elastic{ name = "alloy", young = young, poisson = 0, density = 2700 }
local bar = substructure{
  name = "bar", material = alloy, mesh = mesh.box{ size = { length, width, p.height }, cells = { p.n, 1, 1 } },
}
local middle = support.symmetry{ name = "middle", on = { bar:face "zmax", bar:face "ymin" } }
-- A ground that is too high by this presses evenly, since nu = 0.
local ground = support.wall{ name = "ground", on = bar:face "zmin", friction = p.mu, gap = -p.press * p.height / young }

local stiffness, grip = young * width * p.height, p.mu * p.press * width  -- E A (N), q (N/m)
local most = 0.6 * grip * length                                          -- slides over six tenths of the bar
local amplitudes, points = {}, { 0 }
for i = 1, 5 do
  amplitudes[i] = i / 5 * most
  points[#points + 1] = amplitudes[i]
  points[#points + 1] = -amplitudes[i]
end
points[#points + 1] = most
local times = {}
for i = 1, #points do times[i] = (i - 1) / (#points - 1) end

local press = step.static{ name = "press" }
local cycle = step.static{
  name = "cycle", after = press, increments = p.m * (#points - 1),
  loads = { load.force{ on = bar:face "xmin", x = history.piecewise{ times = times, values = points } } },
}

local joint = output.loop{ name = "bar", on = ground, between = bar:face "xmin", direction = { 1, 0, 0 }, after = press }
local result = problem{
  name = "goodman", substructures = { bar }, supports = { middle, ground }, steps = { press, cycle },
  solver = solver.latin{ max_iterations = 2000 },
  outputs = { joint, output.joint{ name = "sole", on = ground }, output.energy{} },
}:run{}

local function say(what, value, unit) print(("%-58s %.4g %s"):format(what .. ":", value, unit)) end

local cycles, worst, far, masing = result[joint].cycles, 0, 0, 0
for i = 1, #cycles.loss do
  local force = amplitudes[i]
  local loss, reach = 2 / 3 * force^3 / (stiffness * grip), force^2 / (2 * stiffness * grip)
  say(("loss at %.0f N, of %.4g J, error"):format(force, loss), 100 * (cycles.loss[i] / loss - 1), "%")
  worst = math.max(worst, math.abs(cycles.loss[i] / loss - 1))
  far = math.max(far, math.abs(cycles.amplitude[i] / reach - 1))
  masing = math.max(masing, math.abs(cycles.masing_loss[i] / cycles.loss[i] - 1))
end
say("cycles", #cycles.loss, "")
say("loss, largest error", 100 * worst, "%")
say("displacement, largest error", 100 * far, "%")
say("loss that Masing's rule takes from first loading, off by", 100 * masing, "%")
say("exponent over the force (3)", result[joint].exponent, "")
say("exponent over the displacement (1.5)", result[joint].displacement_exponent, "")
