-- pulse.lua -- a pulse runs down three blocks that rub on each other: what tuned masses gain in explicit increments.
--
--        | half-sine of 100 MPa, 4 us
--      +-v-+
--      | c |
--      +---+   contact, friction 0.3
--      | b |
--      +---+   contact, friction 0.3
--      | a |
--     //////   fixed
--
-- Run        dygita run decks/verification/pulse.lua --set tuned=0
--            dygita run decks/verification/pulse.lua --set tuned=0 --set cell=3        --set explicit=0: implicit
-- See        tests/decks/test_integration.cpp, which compares both with a mesh twice as fine, test_integration_quadratic.cpp for cells of order two
-- Expect     the force between a and b is off by half as much with tuned masses (manual, explicit substructures)
-- Read next  pieces.lua

-- cell: 1 hex8, 2 hex20, 3 hex27, 4 tet10, 5 prism18; n: distances of nodes along a side
local p = param{ n = 8, dt = 0.16*us, tuned = 1, cell = 1, explicit = 1 }
local cell, n = ({ "hex8", "hex20", "hex27", "tet10", "prism18" })[p.cell], p.cell == 1 and p.n or p.n/2
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local side = 10*mm
local function block(name, k)
  return substructure{ name = name, material = steel,
    mesh = mesh.box{ origin = { 0, 0, k*side }, size = { side, side, side }, cells = { n, n, n }, cell = cell } }
end
local a, b, c = block("a", 0), block("b", 1), block("c", 2)
local ab = interface.contact{ name = "ab", between = { a:face "zmax", b:face "zmin" }, friction = 0.3 }
local bc = interface.contact{ name = "bc", between = { b:face "zmax", c:face "zmin" }, friction = 0.3 }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local hit = step.dynamic{ name = "hit", duration = 16*us, dt = p.dt,
  loads = { load.pressure{ on = c:face "zmax", history = history.half_sine{ peak = 100*MPa, duration = 4*us } } } }

problem{
  name = "pulse", substructures = { a, b, c }, interfaces = { ab, bc }, supports = { base }, steps = { hit },
  solver = solver.latin{ integration = p.explicit == 1 and "explicit" or "implicit", mass = p.tuned == 1 and "tuned" or "lumped" },
  outputs = { output.joint{ name = "ab", on = ab }, output.energy{} },
}:run{}
