-- early_yield.lua -- a bolt yields while it is being tightened, and a clamp whose gap is too wide is tightened all the same.
--
--     rod in a sleeve, as in ../verification/rod_in_sleeve.lua, heads stiff:
--        yields      the rod's interface yields at 0.3 of the force that the shortening would make
--        open        the sleeve stands clear of the head by more than the shortening: the joint stays open, without force
--        closes      twice the shortening in two steps: open after the first, clamped after the second
--
-- Run        dygita run decks/hard/early_yield.lua
-- See        out/early_yield/yields/bolt.csv
-- Expect     yields: the yield force (error 6e-9), opening as by hand (2e-5: the heads give a little); open: no force
--            (5e-11 of F); closes: the force of what is left of the shortening after the gap (5e-5). Heads a thousand times
--            stiffer than the rods: rounding keeps the indicator at about 1e-9, which --set static_tolerance=1e-9 may not pass
-- Read next  nothing: these were the hard ones

local p = param{ shorten = 20*um, n = 4, head = 2000*GPa, iterations = 2000, static_tolerance = 1e-8 }

local l, depth, cap = 40*mm, 2*mm, 8*mm
local rod_young, sleeve_young = 2*GPa, 0.7*GPa
local rod_metal    = material.elastic{ name = "rod metal",    young = rod_young,    poisson = 0, density = 1000 }
local sleeve_metal = material.elastic{ name = "sleeve metal", young = sleeve_young, poisson = 0, density = 1000 }
local head_metal   = material.elastic{ name = "head metal",   young = p.head,       poisson = 0, density = 1000 }
local function part(name, metal, from, width, z, height, cells)
  return substructure{
    name = name, material = metal,
    mesh = mesh.box{ origin = { from, 0, z }, size = { width, depth, height }, cells = { math.floor(width / mm + 0.5) // 2, 1, cells } },
  }
end
local rod   = part("rod", rod_metal, 4*mm, 2*mm, 0, l, p.n)
local left  = part("left", sleeve_metal, 0, 4*mm, 0, l, p.n)
local right = part("right", sleeve_metal, 6*mm, 4*mm, 0, l, p.n)
local head  = part("head", head_metal, 0, 10*mm, l, cap, 2)
local foot  = part("foot", head_metal, 0, 10*mm, -cap, cap, 2)
local base   = support.fixed{ name = "base", on = foot:face "zmin" }
local guides = support.symmetry{ name = "guides", on = { left:face "xmin", left:face "ymin", right:face "xmax", right:face "ymin" } }
local thread = interface.bonded{ name = "thread", between = { foot:face "zmax", rod:face "zmin" } }

local k_rod, k_sleeve = rod_young * 2*mm * depth / l, sleeve_young * 8*mm * depth / l
local F = p.shorten / (1 / k_rod + 1 / k_sleeve)

-- Each sleeve half stands bonded on the foot; `gap` is between it and the head.
local function clamp(name, yield, gap, steps_)
  local shank = interface.plastic{ name = "shank", between = { rod:face "zmax", head:face "zmin" }, yield = yield }
  local seats, feet = {}, {}
  for i, half in ipairs{ left, right } do
    feet[i] = interface.bonded{ name = half.name .. "_foot", between = { foot:face "zmax", half:face "zmin" } }
    seats[i] = interface.contact{ name = half.name .. "_head", between = { half:face "zmax", head:face "zmin" }, friction = 0, gap = gap }
  end
  local steps, last = {}, nil
  for k = 1, steps_ do
    last = step.static{ name = "tighten_" .. k, after = last, increments = 2, loads = { load.shortening{ on = shank, by = k * p.shorten } } }
    steps[k] = last
  end
  steps[#steps + 1] = step.dynamic{ name = "rest", after = last, duration = 50*us, dt = 1*us }
  local bolt, clamped = output.joint{ name = "bolt", on = shank }, output.resultant{ name = "clamped", on = seats }
  local result = problem{
    name = "early_yield", substructures = { rod, left, right, head, foot },
    interfaces = { thread, shank, feet[1], feet[2], seats[1], seats[2] }, supports = { base, guides }, steps = steps,
    solver = solver.latin{ max_iterations = p.iterations, static_tolerance = p.static_tolerance },
    outputs = { bolt, clamped, output.energy{} },
  }:run{ case = name }
  return result, bolt, clamped, steps
end
local function verdict(result) return result.converged and "converged" or "NOT converged" end

local yielding = 0.3 * F
local r, bolt = clamp("yields", yielding / (2*mm * depth), 0, 1)
print(("yields: force, error: %.3e; opening, error: %.3e; %s"):format(r[bolt].normal.last / yielding - 1,
  r[bolt].plastic_opening.last / (p.shorten - yielding * (1 / k_rod + 1 / k_sleeve)) - 1, verdict(r)))
r, bolt = clamp("open", 1e9, 30*um, 1)
print(("open: largest force, of F: %.3e; %s"):format(math.max(r[bolt].normal.max, -r[bolt].normal.min) / F, verdict(r)))
local after, unused
r, bolt, unused, after = clamp("closes", 1e9, 30*um, 2)
local left_over = (2 * p.shorten - 30*um) / (1 / k_rod + 1 / k_sleeve)
print(("closes: force after the first step, of F: %.3e; after the second, error: %.3e; %s"):format(
  r[bolt].normal:at(after[1]) / F, r[bolt].normal:at(after[2]) / left_over - 1, verdict(r)))
