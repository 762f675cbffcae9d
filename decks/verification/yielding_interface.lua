-- yielding_interface.lua -- a tension wave meets an interface that yields: what gets through is exact, and so is the opening.
--
--    non-reflecting |==========P==========|--> traction, a step
--                     left   plastic  right
--
-- Run        dygita run decks/verification/yielding_interface.lua    --set n=240     --set cfl=1
-- See        paraview out/yielding_interface/perfect/yielding_interface.pvd    colour by stress zz
-- Expect     without hardening the yield stress, 120 MPa of 200, gets through, to rounding; the interface opens at
--            2 (s - yield) / (rho c) = 4 m/s: 0.4 % less at the end, for the front is not sharp. With hardening h the stress rises as
--            s - (s - yield) exp(-2 h t / (rho c)): 0.64 % rms of s (0.21 % at n = 240), opening 1.3 % more (0.5 %): the front again; n = 60,
--            cfl = 0.5. --solver latin (lumped mass): 1.2 %, 3.1 %
-- Read next  rod_in_sleeve.lua

local p = param{ n = 60, cfl = 0.5, stress = 200*MPa, yield = 120*MPa, hardening = 5*MPa/um }

local E, rho, L, side = 200*GPa, 8000, 50*mm, 5*mm
local c = math.sqrt(E / rho)
local T = L / c
local steel = material.elastic{ name = "steel", young = E, poisson = 0, density = rho }
local function bar(name, from)
  return substructure{
    name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, from }, size = { side, side, L }, cells = { 1, 1, p.n } },
  }
end
local left, right = bar("left", 0), bar("right", L)
local out = support.absorbing{ name = "out", on = left:face "zmin" }
local pull = step.dynamic{                       -- until what the interface sends back comes again
  name = "pull", duration = 3*T, dt = p.cfl * L / p.n / c,
  loads = { load.traction{ on = right:face "zmax", z = history.step{ value = p.stress } } },
}

local function say(what, value, unit) print(("%-58s %.4g %s"):format(what .. ":", value, unit)) end

local function case(name, h)
  local joint = interface.plastic{
    name = "joint", between = { left:face "zmax", right:face "zmin" }, yield = p.yield, hardening = h,
  }
  local through, state = output.resultant{ name = "through", on = joint }, output.joint{ name = "state", on = joint }
  local beam = problem{
    name = "yielding_interface", substructures = { left, right }, interfaces = { joint }, supports = { out },
    steps = { pull }, outputs = { through, state, output.energy{}, output.vtk{ frames = 60 } },
    solver = solver.latin{ mass = "tuned" },
  }
  local result = beam:run{ case = name }

  -- The exact solution, t from the arrival, and the errors.
  local rate = 2 * h / (rho * c)
  local function stress(t) return p.stress - (p.stress - p.yield) * math.exp(-rate * t) end
  local function opening(t)
    if h == 0 then return 2 * (p.stress - p.yield) / (rho * c) * t end
    return (p.stress - p.yield) / h * (1 - math.exp(-rate * t))
  end
  local force, middle, sum, n, largest = result[through].normal, result[through].time, 0, 0, 0
  for i = 1, #force do
    local t = middle[i] - T
    if t > 0.1*T and t < 1.9*T then
      local off = force[i] / side^2 / stress(t) - 1
      sum, n, largest = sum + (off * stress(t) / p.stress)^2, n + 1, math.max(largest, math.abs(off))
    end
  end
  local end_of_it = #force
  local opened = result[state].plastic_opening[end_of_it] / opening(middle[end_of_it] - T) - 1
  say(name .. ": stress from 0.1 to 1.9 T after the arrival, max error", 100 * largest, "%")
  say(name .. ": the same, rms error of the incident stress", 100 * math.sqrt(sum / n), "%")
  say(name .. ": opening at the end, error", 100 * opened, "%")
end

case("perfect", 0)
case("hardening", p.hardening)
