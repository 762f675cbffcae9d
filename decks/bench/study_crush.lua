-- study_crush.lua -- what starting from another case saves in a dynamic step: the block of crush.lua for ten coefficients of friction.
--
--        | 80 MPa, 15 us
--        v
--     +-----+
--     |punch|   steel
--     +-----+   contact with friction mu, first ... first + 9 by
--     |block|   aluminium, on a wall
--     +-----+
--
-- Run        dygita run decks/bench/study_crush.lua --set by=0.01          --set cold=1     (every case from scratch)
-- See        the last lines: iterations of all cases
-- Expect     the figures of manual/howto/studies.md
-- Read next  decks/study_friction.lua, where more is saved

local p = param{ first = 0.2, by = 0.05, cases = 10, cold = 0, n = 2 }

local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local aluminium = material.elastic{ name = "aluminium", young = 70*GPa, poisson = 0.3, density = 2700 }
local side, height = 10*mm, 20*mm
local function block(name, metal, z)
  return substructure{ name = name, material = metal,
    mesh = mesh.box{ origin = { 0, 0, z }, size = { side, side, height }, cells = { p.n, p.n, 2*p.n } } }
end
local specimen, punch = block("specimen", aluminium, 0), block("punch", steel, height)
local wall = support.wall{ name = "wall", on = specimen:face "zmin" }
local symmetry = support.symmetry{ name = "symmetry",
  on = { specimen:face "xmin", specimen:face "ymin", punch:face "xmin", punch:face "ymin" } }
local shot = step.dynamic{ name = "shot", duration = 60*us, dt = 0.3*us,
  loads = { load.pressure{ on = punch:face "zmax", history = history.half_sine{ peak = 80*MPa, duration = 15*us } } } }

local last, iterations = nil, 0
for i = 1, p.cases do
  local mu = p.first + p.by * (i - 1)
  local touch = interface.contact{ name = "touch", between = { specimen:face "zmax", punch:face "zmin" }, friction = mu }
  last = problem{ name = "study_crush", substructures = { specimen, punch }, interfaces = { touch }, supports = { wall, symmetry },
    steps = { shot }, solver = solver.latin{ integration = "implicit" }, outputs = { output.joint{ name = "touch", on = touch }, output.energy{} },
  }:run{ case = ("mu_%.3f"):format(mu), at = { mu = mu }, start_from = p.cold == 0 and last or nil, check_cold = i == p.cases }
  iterations = iterations + last.iterations
end
print(("iterations of all cases: %d"):format(iterations))
