-- study_friction.lua -- a parametric study: how much energy a lap joint takes from a cycle of shear, for ten coefficients of friction.
--
--              pressure 20 MPa
--           | | | | | | | | | |
--           v v v v v v v v v v
--          +-------------------+
--          |       upper       | <-> shear, three cycles of growing amplitude, up to 3 kN
--          +-------------------+   contact with friction
--     fixed|       lower       |
--          +-------------------+
--
-- Run        dygita run decks/study_friction.lua            --set cold=1   (every case from scratch)     --set n=8
-- See        out/lap/study.svg    a chart of each figure against the friction, and of the iterations
--            out/lap/study.csv    the same as a table, one row per case
-- Expect     the work of friction falls from 1.00 mJ at mu = 0.15 to 0.05 mJ at 0.42: the more friction, the less slides; mesh error +24 %
--            at n = 4 (0.87 mJ at n = 8, 0.84 at n = 12 for mu = 0.15, limit 0.81). Each case
--            starts from the interface fields of the case before: 4259 iterations for the ten, 9833 from scratch
--            (--set cold=1), 57 % saved, with the same answers (3e-7 apart at most)
-- Read next  manual/howto/studies.md: when starting from another case pays, and when it does not

local p = param{ first = 0.15, by = 0.03, cases = 10, increments = 20, cold = 0, n = 4, shear = 3*kN }

-- What no case changes is declared once ... --------------------------------

local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function plate(name, z)
  return substructure{ name = name, material = steel,
    mesh = mesh.box{ origin = { 0, 0, z }, size = { 60*mm, 20*mm, 10*mm }, cells = { 3*p.n, p.n, math.max(2, p.n - 1) } } }
end
local lower, upper = plate("lower", 0), plate("upper", 10*mm)
local supports = {
  support.fixed{ name = "held", on = lower:face "xmin" },
  support.symmetry{ name = "bed", on = lower:face "zmin" },
}
local clamp = load.pressure{ on = upper:face "zmax", history = 20*MPa }
local press = step.static{ name = "press", loads = { clamp } }
local cycles = step.static{
  name = "cycles", after = press, increments = 3*p.increments,
  loads = { clamp, load.force{ on = upper:face "xmax", x = function(t) return p.shear * t * math.sin(6*math.pi*t) end } },
}

-- ... and a case is a function of what changes ---------------------------------------------------------------------------

local function lap(mu)
  local contact = interface.contact{ name = "contact", between = { lower:face "zmax", upper:face "zmin" }, friction = mu }
  return problem{
    name = "lap", substructures = { lower, upper }, interfaces = { contact }, supports = supports, steps = { press, cycles },
    outputs = {
      output.joint{ name = "joint", on = contact },
      output.history{ name = "shear", on = upper:face "xmax", quantity = "displacement", direction = { 1, 0, 0 } },
    },
  }
end

local last, iterations
for i = 1, p.cases do
  local mu = p.first + p.by * (i - 1)
  last = lap(mu):run{
    case = ("mu_%.3f"):format(mu), at = { mu = mu }, start_from = p.cold == 0 and last or nil, check_cold = i == p.cases // 2,
  }
  iterations = (iterations or 0) + last.iterations
end
print(("iterations of all cases: %d"):format(iterations))
