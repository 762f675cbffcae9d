-- Light parts on heavy ones, by which what the tolerance leaves on a spectrum is held against the truth: masses of 1/350
-- to 1/14000, bonded and in contact, shaken and struck. dygita run light_parts.lua --set scene=3
local p = param{ scene = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local aluminium = material.elastic{ name = "aluminium", young = 70*GPa, poisson = 0.33, density = 2700 }
local laminate = material.elastic{ name = "laminate", young = 20*GPa, poisson = 0.2, density = 2000, damping_ratio = 0.01, damping_frequency = 1*kHz }
local function box(name, size, cells, at, of, v)
  return substructure{ name = name, material = of or steel, velocity = v, place = at and { translate = at },
    mesh = mesh.box{ size = size, cells = cells } }
end
local parts, joints, supports, steps, outputs = {}, {}, {}, {}, {}
local dt, duration, loads = 5*us, 4*ms, nil
local function bonded(a, b) joints[#joints+1] = interface.bonded{ name = "bond " .. #joints, between = { a, b } } end
local X, Z = { 1, 0, 0 }, { 0, 0, 1 }
local see = {}
local s = p.scene
local heavy = box("heavy", { 120*mm, 80*mm, 60*mm }, { 4, 3, 2 })  -- 4.5 kg
local half = history.half_sine
local function base(direction, peak, t)
  local held = support.fixed{ name = "held", on = heavy:face "zmin" }
  supports = { held }
  loads = { load.base_acceleration{ on = held, direction = direction, history = half{ peak = peak, duration = t } } }
end
if s == 1 or s == 2 then -- a board of 8 g on four standoffs, bonded: shaken; struck in free flight
  local board = box("board", { 60*mm, 40*mm, 1.6*mm }, { 12, 8, 1 }, { 30*mm, 20*mm, 66*mm }, laminate)
  parts = { heavy, board }
  for i, at in ipairs{ { 30, 20 }, { 85, 20 }, { 30, 55 }, { 85, 55 } } do
    local st = box("standoff " .. i, { 5*mm, 5*mm, 6*mm }, { 1, 1, 2 }, { at[1]*mm, at[2]*mm, 60*mm }, aluminium)
    parts[#parts+1] = st
    bonded(heavy:face "zmax", st:face "zmin") bonded(st:face "zmax", board:face "zmin")
  end
  if s == 2 then
    loads = { load.force{ on = heavy:face "xmin", x = half{ peak = 40*kN, duration = 200*us }, z = half{ peak = 20*kN, duration = 200*us } } }
  else base({ 0.3, 0, 1 }, 5000, 300*us) end
  see = { { board:where(function(x, y) return near(x, 60*mm) and near(y, 40*mm) end), Z, "board" }, { heavy:face "zmax", Z, "heavy" } }
elseif s == 3 or s == 4 then -- a web of 3 g as a cantilever: shaken; struck
  local web = box("web", { 2*mm, 20*mm, 30*mm }, { 1, 4, 8 }, { 60*mm, 30*mm, 60*mm }, aluminium)
  parts = { heavy, web }
  bonded(heavy:face "zmax", web:face "zmin")
  if s == 3 then base({ 1, 0, 0.2 }, 5000, 300*us)
  else loads = { load.force{ on = heavy:face "xmin", x = half{ peak = 40*kN, duration = 100*us } } } end
  see = { { web:face "zmax", X, "web" } , { heavy:face "zmax", X, "heavy" } }
elseif s == 5 then -- a tab of 0.3 g
  local tab = box("tab", { 1*mm, 6*mm, 20*mm }, { 1, 2, 8 }, { 60*mm, 30*mm, 60*mm }, aluminium)
  parts = { heavy, tab }
  bonded(heavy:face "zmax", tab:face "zmin")
  base({ 1, 0, 0.2 }, 5000, 500*us)
  see = { { tab:face "zmax", X, "tab" } }
elseif s == 6 or s == 7 then -- a cap of 3 g on two posts that it is clamped to: shaken; struck
  local cap = box("cap", { 30*mm, 20*mm, 2*mm }, { 6, 4, 1 }, { 45*mm, 30*mm, 68*mm }, aluminium)
  parts = { heavy, cap }
  local rod = box("rod", { 6*mm, 20*mm, 8*mm }, { 2, 4, 3 }, { 57*mm, 30*mm, 60*mm }, aluminium)
  bonded(heavy:face "zmax", rod:face "zmin") 
  joints[#joints+1] = interface.bonded{ name = "shank", between = { rod:face "zmax", cap:face "zmin" } }
  parts[#parts+1] = rod
  for i, x in ipairs{ 45, 69 } do
    local post = box("post " .. i, { 6*mm, 20*mm, 8*mm }, { 1, 4, 2 }, { x*mm, 30*mm, 60*mm }, aluminium)
    parts[#parts+1] = post
    joints[#joints+1] = interface.contact{ name = "below " .. i, between = { heavy:face "zmax", post:face "zmin" }, friction = 0.3 }
    joints[#joints+1] = interface.contact{ name = "above " .. i, between = { post:face "zmax", cap:face "zmin" }, friction = 0.3 }
  end
  local pre = load.preload{ on = joints[2], force = 500 }
  steps[1] = step.static{ name = "tighten", increments = 2, loads = { pre } }
  duration = 1.5*ms dt = 2*us
  if s == 6 then base({ 1, 0.3, 1 }, 5000, 200*us)
  else
    supports = { support.fixed{ name = "held", on = heavy:face "zmin" } }
    loads = { load.force{ on = heavy:face "xmin", x = half{ peak = 40*kN, duration = 60*us } } } end
  see = { { cap:face "xmax", Z, "cap" } , { heavy:face "zmax", X, "heavy" } }
elseif s == 8 then -- a block of 9 g, pressed on
  local light = box("light", { 20*mm, 20*mm, 8*mm }, { 4, 4, 2 }, { 50*mm, 30*mm, 60*mm }, aluminium)
  parts = { heavy, light }
  joints[1] = interface.contact{ name = "foot", between = { heavy:face "zmax", light:face "zmin" }, friction = 0.3 }
  local press = load.pressure{ on = light:face "zmax", history = 5*MPa }
  steps[1] = step.static{ name = "press", increments = 2, loads = { press } }
  base({ 1, 0, 0.5 }, 5000, 100*us)
  loads[2] = press
  duration = 1*ms dt = 1*us
  see = { { light:face "zmax", X, "light" } }
elseif s == 9 then -- a board of 5 g on a bracket of 13 g
  local a = box("bracket", { 4*mm, 40*mm, 30*mm }, { 1, 5, 5 }, { 60*mm, 20*mm, 60*mm }, aluminium)
  local b = box("board", { 40*mm, 40*mm, 1.6*mm }, { 8, 8, 1 }, { 60*mm, 20*mm, 90*mm }, laminate)
  parts = { heavy, a, b }
  bonded(heavy:face "zmax", a:face "zmin") bonded(a:face "zmax", b:face "zmin")
  base({ 0.3, 0.2, 1 }, 5000, 500*us)
  duration = 6*ms
  see = { { b:face "xmax", Z, "board" }, { a:face "zmax", X, "bracket" } }
end
steps[#steps+1] = step.dynamic{ name = "shock", after = steps[1], duration = duration, dt = dt, loads = loads }
for i, q in ipairs(see) do
  local a = output.history{ name = "a_" .. q[3], on = q[1], direction = q[2], quantity = "acceleration" }
  outputs[#outputs+1] = a
  outputs[#outputs+1] = output.srs{ name = "s_" .. q[3], of = a, from = 500, to = 10000, per_octave = 6, taper = duration / 4 }
end
problem{ name = "scene " .. s, solver = solver.latin{ integration = "implicit" }, substructures = parts, interfaces = joints, supports = supports, steps = steps, outputs = outputs }:run{}
