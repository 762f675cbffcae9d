-- two_bars.lua -- two equal bars meet head on, turn their motion into strain and back, and part.
--
--       -->  100 m/s          100 m/s  <--
--    +-------------+         +-------------+
--    |    left     |touching |    right    |        1 mm x (0.1 mm)^2 each
--    +-------------+         +-------------+
--
-- Run        dygita run decks/verification/two_bars.lua              --set n=400     --set cfl=1
-- See        paraview out/two_bars/base/two_bars.pvd                 colour by velocity z
-- Expect     stress -rho c v = -100 MPa within 0.043 % rms over the contact; release after 2 L / c = 2 us, one step (5 ns) late
--            at n = 100, cfl = 0.5; at 1 us all the kinetic energy, 5.0e-5 J a bar, is strain energy (99.8 % of it).
--            --solver latin (lumped mass, contact nodes with mass): 0.13 %, 3 steps, 98.7 %
-- Read next  unequal_bars.lua

local p = param{ n = 100, cfl = 0.5, velocity = 100 }

local E, rho, L, side = 1*GPa, 1000, 1*mm, 0.1*mm
local c = math.sqrt(E / rho)
local dt = p.cfl * L / p.n / c
local metal = material.elastic{ name = "metal", young = E, poisson = 0, density = rho }
local function bar(name, from, velocity)
  return substructure{
    name = name, material = metal, velocity = { 0, 0, velocity },
    mesh = mesh.box{ origin = { 0, 0, from }, size = { side, side, L }, cells = { 1, 1, p.n } },
  }
end
local left, right = bar("left", 0, p.velocity), bar("right", L, -p.velocity)
local touch = interface.contact{ name = "touch", between = { left:face "zmax", right:face "zmin" } }
local meet = step.dynamic{ name = "meet", duration = 3*us, dt = dt }
local push, energy = output.resultant{ name = "push", on = touch }, output.energy{}
local impact = problem{
  name = "two_bars", substructures = { left, right }, interfaces = { touch }, steps = { meet },
  outputs = { push, energy, output.vtk{ frames = 60 } },
  solver = solver.latin{ mass = "tuned", massless_contact = true },
}
local result = impact:run{}

-- The exact solution and the errors -----------------------------------------------------

local stress, release = -rho * c * p.velocity, 2 * L / c
local force, middle = result[push].normal, result[push].time
local sum, n, largest, last, count, touching = 0, 0, 0, 0, 0, false
for i = 1, #force do
  local t, s = middle[i], force[i] / side^2
  if t > 0.05 * release and t < 0.95 * release then
    sum, n, largest = sum + (s / stress - 1)^2, n + 1, math.max(largest, math.abs(s / stress - 1))
  end
  if force[i] < 0 then last = i end
  if force[i] < 0 and not touching then count = count + 1 end
  touching = force[i] < 0
end
local kinetic = 2 * 0.5 * rho * side^2 * L * p.velocity^2

local function say(what, value, unit) print(("%-58s %.4g %s"):format(what .. ":", value, unit)) end
say("stress over the contact but 5 % at each end, rms error", 100 * math.sqrt(sum / n), "%")
say("the same, max error", 100 * largest, "%")
say("spells of contact", count, "")
say("release, time steps late", last - release / dt, "")
say("release, us late", (last * dt - release) / us, "us")
say("strain energy at L / c, of all", 100 * result[energy].strain:at(L / c) / kinetic, "%")
say("energy exchanged with the scheme at the end, of all", 100 * result[energy].scheme.last / kinetic, "%")
