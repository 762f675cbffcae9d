-- Scenes by which the error estimates of a run are held against the truth: effectivity scenes.
-- dygita run scenes.lua --set scene=3 --set n=2 --set finer=4     cells n times finer, time steps 4 times shorter
local p = param{ scene = 1, n = 1, finer = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local aluminium = material.elastic{ name = "aluminium", young = 70*GPa, poisson = 0.33, density = 2700 }
local laminate = material.elastic{ name = "laminate", young = 20*GPa, poisson = 0.2, density = 3000 }
local damped = material.elastic{ name = "damped", young = 70*GPa, poisson = 0.33, density = 2700, damping_ratio = 0.02, damping_frequency = 2*kHz }
local function box(name, size, cells, more)
  more = more or {}
  for i = 1, 3 do cells[i] = cells[i] * p.n end
  return substructure{ name = name, material = more.of or steel, velocity = more.velocity, place = more.at,
    mesh = mesh.box{ size = size, cells = cells, cell = more.cell, order = more.cell and 2 or 1 } }
end
local parts, joints, supports, steps, places = {}, {}, {}, {}, {}
local dt, duration = 0.5*us, 60*us
local X, Y, Z = { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }
local foot
local function fixed(on) foot, supports[1] = on, support.fixed{ name = "held", on = on } return supports[1] end
local function shock(loads, after) steps[#steps+1] = step.dynamic{ name = "shock", after = after, duration = duration, dt = dt / p.finer, loads = loads } end
local function see(on, direction) places[#places+1] = { on, direction } end
local function at_x(part, x, y) return part:where(function(a, b) return near(a, x) and (not y or near(b, y)) end) end
local function bonded(a, b) joints[#joints+1] = interface.bonded{ name = "bond " .. #joints, between = { a, b } } end
local pulse, half = history.haversine, history.half_sine

if p.scene == 1 then -- a pulse through a change of impedance
  local a, b = box("a", { 5*mm, 5*mm, 100*mm }, { 1, 1, 25 }), box("b", { 5*mm, 5*mm, 60*mm }, { 1, 1, 15 }, { of = aluminium, at = { 0, 0, 100*mm } })
  parts, joints = { a, b }, { interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = 0.2 } }
  fixed(b:face "zmax")
  shock{ load.pressure{ on = a:face "zmin", history = pulse{ peak = 50*MPa, duration = 15*us } } }
  see(a:face "zmin", Z) see(a:face "zmax", Z)
elseif p.scene == 2 then -- a block hits a bar
  local a = box("a", { 5*mm, 5*mm, 100*mm }, { 1, 1, 25 })
  local b = box("b", { 5*mm, 5*mm, 20*mm }, { 1, 1, 5 }, { at = { 0, 0, 100*mm }, velocity = { 0, 0, -5 } })
  parts, joints = { a, b }, { interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" } } }
  shock{}
  see(a:face "zmin", Z) see(b:face "zmax", Z)
elseif p.scene == 3 then -- a cantilever on a shaken base
  local a = box("a", { 60*mm, 6*mm, 4*mm }, { 10, 2, 1 })
  parts, dt, duration = { a }, 2*us, 4000*us
  shock{ load.base_acceleration{ on = fixed(a:face "xmin"), direction = { 0.2, 0.3, 1 }, history = half{ peak = 10000, duration = 200*us } } }
  see(a:face "xmax", Z) see(a:face "xmax", Y)
elseif p.scene == 4 then -- a block pressed on a block, pushed aside
  local a, b = box("a", { 20*mm, 20*mm, 12*mm }, { 4, 4, 3 }), box("b", { 12*mm, 12*mm, 12*mm }, { 3, 3, 3 }, { of = aluminium, at = { 4*mm, 4*mm, 12*mm } })
  parts, joints = { a, b }, { interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = 0.3 } }
  fixed(a:face "zmin")
  local press = load.pressure{ on = b:face "zmax", history = 20*MPa }
  steps[1] = step.static{ name = "press", loads = { press } }
  shock({ press, load.traction{ on = b:face "zmax", x = pulse{ peak = 6*MPa, duration = 20*us } } }, steps[1])
  see(a:face "xmax", X) see(b:face "xmax", X)
elseif p.scene == 5 then -- a bracket of two plates, bonded, unlike meshes
  local a, b = box("a", { 40*mm, 20*mm, 4*mm }, { 8, 4, 1 }), box("b", { 4*mm, 20*mm, 30*mm }, { 1, 3, 5 }, { of = aluminium, at = { 0, 0, 4*mm } })
  parts, joints = { a, b }, { interface.bonded{ name = "joint", between = { a:face "zmax", b:face "zmin" } } }
  dt, duration = 2*us, 1000*us
  shock{ load.base_acceleration{ on = fixed(a:face "xmax"), direction = Z, history = half{ peak = 10000, duration = 100*us } } }
  see(b:face "zmax", X) see(a:face "xmin", Z)
elseif p.scene == 6 then -- a cap on two posts, held by a tightened rod
  local a, c = box("a", { 20*mm, 8*mm, 4*mm }, { 10, 4, 2 }), box("c", { 20*mm, 8*mm, 4*mm }, { 10, 4, 2 }, { at = { 0, 0, 16*mm } })
  local function post(name, x) return box(name, { 4*mm, 8*mm, 12*mm }, { 2, 4, 6 }, { at = { x, 0, 4*mm } }) end
  local left, right, rod = post("left", 0), post("right", 16*mm), post("rod", 8*mm)
  parts = { a, c, left, right, rod }
  joints = { interface.bonded{ name = "shank", between = { rod:face "zmax", c:face "zmin" } }, interface.bonded{ name = "foot", between = { a:face "zmax", rod:face "zmin" } } }
  for i, q in ipairs{ left, right } do
    joints[#joints+1] = interface.contact{ name = "below " .. i, between = { a:face "zmax", q:face "zmin" }, friction = 0.2 }
    joints[#joints+1] = interface.contact{ name = "above " .. i, between = { q:face "zmax", c:face "zmin" }, friction = 0.2 }
  end
  fixed(a:face "zmin")
  steps[1] = step.static{ name = "tighten", increments = 2, loads = { load.preload{ on = joints[1], force = 3*kN } } }
  duration = 100*us
  shock({ load.traction{ on = c:face "zmax", x = pulse{ peak = 8*MPa, duration = 25*us }, z = pulse{ peak = 5*MPa, duration = 25*us } } }, steps[1])
  see(c:face "zmax", Z) see(c:face "zmax", X)
elseif p.scene == 7 then -- a bar whose joint yields
  local a, b = box("a", { 5*mm, 5*mm, 100*mm }, { 1, 1, 25 }), box("b", { 5*mm, 5*mm, 60*mm }, { 1, 1, 15 }, { at = { 0, 0, 100*mm } })
  parts, joints = { a, b }, { interface.plastic{ name = "joint", between = { a:face "zmax", b:face "zmin" }, yield = 30*MPa, hardening = 2e12 } }
  shock{ load.pressure{ on = a:face "zmin", history = pulse{ peak = -80*MPa, duration = 15*us } } }
  see(a:face "zmin", Z) see(b:face "zmax", Z)
elseif p.scene == 8 then -- a block falls on a plate that is held at its ends
  local a = box("a", { 60*mm, 10*mm, 4*mm }, { 12, 2, 1 })
  local b = box("b", { 10*mm, 10*mm, 10*mm }, { 2, 2, 2 }, { at = { 25*mm, 0, 4*mm }, velocity = { 0, 0, -1 } })
  parts, joints = { a, b }, { interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = 0.2 } }
  fixed{ a:face "xmin", a:face "xmax" }
  dt, duration = 1*us, 300*us
  shock{}
  see(b:face "zmax", Z) see(at_x(a, 15*mm), Z)
elseif p.scene == 9 or p.scene == 11 then -- a cantilever of cells of order two, pushed aside
  local a = box("a", { 40*mm, 6*mm, 6*mm }, { 8, 1, 1 }, { cell = p.scene == 9 and "tet10" or "hex20" })
  parts, dt, duration = { a }, 2*us, 600*us
  fixed(a:face "xmin")
  shock{ load.force{ on = a:face "xmax", y = half{ peak = 300, duration = 60*us }, z = half{ peak = 100, duration = 60*us } } }
  see(a:face "xmax", Z) see(a:face "xmax", Y)
elseif p.scene == 10 or p.scene == 12 then -- a square bar twisted, two cells across; one
  local across = p.scene == 10 and 2 or 1
  local a = box("a", { 60*mm, 8*mm, 8*mm }, { 8, across, across })
  parts, dt, duration = { a }, 1*us, 300*us
  fixed(a:face "xmin")
  shock{ load.torque{ on = a:face "xmax", axis = X, history = pulse{ peak = 10, duration = 60*us } } }
  see(at_x(a, 60*mm, 8*mm), Z) see(at_x(a, 30*mm, 8*mm), Z)
elseif p.scene == 13 then -- a cantilever let go: forty periods
  local a = box("a", { 100*mm, 5*mm, 5*mm }, { 5, 1, 1 })
  parts, dt, duration = { a }, 100*us, 100*ms
  fixed(a:face "xmin")
  local pull = load.force{ on = a:face "xmax", z = 10 }
  steps[1] = step.static{ name = "pull", loads = { pull } }
  shock({ load.force{ on = a:face "xmax", z = 0 } }, steps[1])
  see(a:face "xmax", Z)
elseif p.scene == 14 then -- two plates pressed together on a shaken base
  local a, b = box("a", { 240*mm, 20*mm, 10*mm }, { 24, 2, 2 }), box("b", { 240*mm, 20*mm, 10*mm }, { 24, 2, 2 }, { at = { 0, 0, 10*mm } })
  parts, joints = { a, b }, { interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = 0.5 } }
  dt, duration = 20*us, 20*ms
  local base = fixed{ a:face "xmin", b:face "xmin" }
  local press = { load.pressure{ on = b:face "zmax", history = 20*MPa }, load.pressure{ on = a:face "zmin", history = 20*MPa } }
  steps[1] = step.static{ name = "press", increments = 2, loads = press }
  shock({ press[1], press[2], load.base_acceleration{ on = base, direction = Z, history = half{ peak = 1000, duration = 0.5*ms } } }, steps[1])
  see(b:face "xmax", Z)
elseif p.scene == 15 then -- a board on four standoffs, bonded, on a shaken base
  local base = box("base", { 60*mm, 40*mm, 10*mm }, { 6, 4, 1 })
  local board = box("board", { 60*mm, 40*mm, 2*mm }, { 12, 8, 1 }, { of = laminate, at = { 0, 0, 20*mm } })
  parts = { base, board }
  for i, at in ipairs{ { 0, 0 }, { 55*mm, 0 }, { 0, 35*mm }, { 55*mm, 35*mm } } do
    local standoff = box("standoff " .. i, { 5*mm, 5*mm, 10*mm }, { 1, 1, 2 }, { of = aluminium, at = { at[1], at[2], 10*mm } })
    parts[#parts+1] = standoff
    bonded(base:face "zmax", standoff:face "zmin") bonded(standoff:face "zmax", board:face "zmin")
  end
  dt, duration = 4*us, 2*ms
  shock{ load.base_acceleration{ on = fixed(base:face "zmin"), direction = { 0.3, 0, 1 }, history = half{ peak = 5000, duration = 300*us } } }
  see(at_x(board, 30*mm, 20*mm), Z) see(parts[3]:face "zmax", X)
elseif p.scene == 16 then -- a pulse through a stepped bar, bonded
  local a, b = box("a", { 8*mm, 8*mm, 60*mm }, { 2, 2, 15 }), box("b", { 4*mm, 4*mm, 60*mm }, { 1, 1, 15 }, { at = { 2*mm, 2*mm, 60*mm } })
  parts = { a, b }
  bonded(a:face "zmax", b:face "zmin")
  shock{ load.pressure{ on = a:face "zmin", history = pulse{ peak = 50*MPa, duration = 15*us } } }
  see(a:face "zmin", Z) see(b:face "zmax", Z)
elseif p.scene == 17 then -- a plate held along one edge, with a mass on it that is struck
  local a, b = box("a", { 60*mm, 60*mm, 3*mm }, { 10, 10, 1 }, { of = aluminium }), box("b", { 18*mm, 18*mm, 12*mm }, { 2, 2, 2 }, { at = { 30*mm, 24*mm, 3*mm } })
  parts = { a, b }
  bonded(a:face "zmax", b:face "zmin")
  fixed(a:face "xmin")
  dt, duration = 4*us, 2*ms
  shock{ load.force{ on = b:face "zmax", z = half{ peak = 500, duration = 200*us }, y = half{ peak = 200, duration = 200*us } } }
  see(b:face "zmax", Z) see(at_x(a, 60*mm, 0), Z)
elseif p.scene == 18 then -- two lapped plates, pressed together, struck at the end of one
  local a, b = box("a", { 50*mm, 12*mm, 4*mm }, { 10, 3, 2 }), box("b", { 50*mm, 12*mm, 4*mm }, { 10, 3, 2 }, { of = aluminium, at = { 35*mm, 0, 4*mm } })
  local low, up = box("low", { 10*mm, 12*mm, 3*mm }, { 2, 3, 1 }, { at = { 37*mm, 0, -3*mm } }), box("up", { 10*mm, 12*mm, 3*mm }, { 2, 3, 1 }, { at = { 37*mm, 0, 8*mm } })
  parts = { a, b, low, up }
  bonded(a:face "zmin", low:face "zmax") bonded(b:face "zmax", up:face "zmin")
  joints[#joints+1] = interface.contact{ name = "lap", between = { a:face "zmax", b:face "zmin" }, friction = 0.3 }
  fixed(a:face "xmin")
  local press = { load.pressure{ on = low:face "zmin", history = 30*MPa }, load.pressure{ on = up:face "zmax", history = 30*MPa } }
  steps[1] = step.static{ name = "press", increments = 2, loads = press }
  dt, duration = 2*us, 800*us
  shock({ press[1], press[2], load.traction{ on = b:face "xmax", y = pulse{ peak = 1*MPa, duration = 80*us }, z = pulse{ peak = 1*MPa, duration = 80*us } } }, steps[1])
  see(b:face "xmax", Z) see(a:face "xmax", Z)
elseif p.scene == 19 then -- a bracket on two feet, held by a tightened rod, on a shaken base
  local foot, flange = box("foot", { 40*mm, 12*mm, 4*mm }, { 10, 3, 1 }), box("flange", { 20*mm, 12*mm, 4*mm }, { 5, 3, 1 }, { of = aluminium, at = { 10*mm, 0, 14*mm } })
  local left, right = box("left", { 4*mm, 12*mm, 10*mm }, { 1, 3, 3 }, { at = { 10*mm, 0, 4*mm } }), box("right", { 4*mm, 12*mm, 10*mm }, { 1, 3, 3 }, { at = { 26*mm, 0, 4*mm } })
  local rod, web = box("rod", { 4*mm, 4*mm, 10*mm }, { 1, 1, 3 }, { at = { 18*mm, 4*mm, 4*mm } }), box("web", { 4*mm, 12*mm, 20*mm }, { 1, 3, 5 }, { of = aluminium, at = { 14*mm, 0, 18*mm } })
  parts, joints = { foot, flange, left, right, rod, web }, { interface.bonded{ name = "shank", between = { rod:face "zmax", flange:face "zmin" } } }
  bonded(foot:face "zmax", rod:face "zmin") bonded(flange:face "zmax", web:face "zmin")
  for i, q in ipairs{ left, right } do
    bonded(foot:face "zmax", q:face "zmin")
    joints[#joints+1] = interface.contact{ name = "above " .. i, between = { q:face "zmax", flange:face "zmin" }, friction = 0.3 }
  end
  local base = fixed{ foot:face "xmin", foot:face "xmax" }
  steps[1] = step.static{ name = "tighten", increments = 2, loads = { load.preload{ on = joints[1], force = 2*kN } } }
  dt, duration = 2*us, 800*us
  shock({ load.base_acceleration{ on = base, direction = { 1, 0, 1 }, history = half{ peak = 8000, duration = 120*us } } }, steps[1])
  see(web:face "zmax", X) see(flange:face "zmax", Z)
elseif p.scene == 20 then -- a damped frame of three bars on a shaken base
  local left, right = box("left", { 6*mm, 6*mm, 60*mm }, { 1, 1, 8 }, { of = damped }), box("right", { 6*mm, 6*mm, 60*mm }, { 1, 1, 8 }, { of = damped, at = { 54*mm, 0, 0 } })
  local top = box("top", { 60*mm, 6*mm, 6*mm }, { 10, 1, 1 }, { of = damped, at = { 0, 0, 60*mm } })
  parts = { left, right, top }
  bonded(top:face "zmin", left:face "zmax") bonded(top:face "zmin", right:face "zmax")
  dt, duration = 10*us, 5*ms
  shock{ load.base_acceleration{ on = fixed{ left:face "zmin", right:face "zmin" }, direction = { 1, 0.5, 0.3 }, history = half{ peak = 2000, duration = 500*us } } }
  see(top:face "xmax", X) see(at_x(top, 30*mm), Z)
elseif p.scene == 26 then -- a free block pushed softly: it flies
  local a = box("a", { 20*mm, 20*mm, 20*mm }, { 3, 3, 3 })
  parts, dt, duration = { a }, 2*us, 1000*us
  shock{ load.pressure{ on = a:face "zmin", history = half{ peak = 10*MPa, duration = 200*us } } }
  see(a:face "zmax", Z) see(a:face "xmax", X)
elseif p.scene == 27 then -- a free block pushed along its top: it spins
  local a = box("a", { 20*mm, 20*mm, 20*mm }, { 3, 3, 3 })
  parts, dt, duration = { a }, 1*us, 500*us
  shock{ load.traction{ on = a:face "zmax", x = half{ peak = 0.2*MPa, duration = 40*us } } }
  see(a:face "zmax", X) see(a:face "xmax", Z)
elseif p.scene == 28 then -- a block slides over a plate
  local a, b = box("a", { 60*mm, 20*mm, 8*mm }, { 12, 4, 2 }), box("b", { 20*mm, 10*mm, 5*mm }, { 4, 2, 1 }, { at = { 10*mm, 5*mm, 8*mm } })
  parts, joints = { a, b }, { interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = 0.2 } }
  fixed(a:face "zmin")
  dt, duration = 1*us, 1000*us
  shock{ load.pressure{ on = b:face "zmax", history = 5*MPa }, load.traction{ on = b:face "zmax", x = half{ peak = 3*MPa, duration = 200*us } } }
  see(b:face "zmax", X) see(a:face "xmax", X)
elseif p.scene == 29 then -- a bar hits a wall and flies off
  local a = box("a", { 5*mm, 5*mm, 100*mm }, { 1, 1, 25 }, { velocity = { 0, 0, -5 } })
  parts, supports, duration = { a }, { support.wall{ name = "wall", on = a:face "zmin" } }, 200*us
  shock{}
  see(a:face "zmax", Z) see(a:face "zmin", Z)
elseif p.scene == 30 then -- a block kicked off a plate
  local a, b = box("a", { 40*mm, 40*mm, 10*mm }, { 6, 6, 2 }), box("b", { 10*mm, 10*mm, 10*mm }, { 2, 2, 2 }, { at = { 15*mm, 15*mm, 10*mm } })
  parts, joints = { a, b }, { interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = 0.2 } }
  fixed(a:face "xmin")
  dt, duration = 1*us, 1000*us
  shock{ load.pressure{ on = a:face "zmin", history = half{ peak = 20*MPa, duration = 50*us } } }
  see(b:face "zmax", Z) see(a:face "xmax", Z)
elseif p.scene == 31 then -- two free bars, bonded, pushed aside: they spin
  local a, b = box("a", { 40*mm, 6*mm, 6*mm }, { 8, 1, 1 }), box("b", { 6*mm, 6*mm, 30*mm }, { 1, 1, 6 }, { of = aluminium, at = { 34*mm, 0, 6*mm } })
  parts, dt, duration = { a, b }, 2*us, 1000*us
  bonded(a:face "zmax", b:face "zmin")
  shock{ load.traction{ on = b:face "zmax", x = half{ peak = 1*MPa, duration = 100*us } } }
  see(b:face "zmax", X) see(a:face "xmin", Z)
elseif p.scene == 32 then -- a nut rattles between two plates
  local a, b = box("a", { 60*mm, 10*mm, 4*mm }, { 12, 2, 1 }), box("b", { 60*mm, 10*mm, 4*mm }, { 12, 2, 1 }, { at = { 0, 0, 10.1*mm } })
  local nut = box("nut", { 6*mm, 6*mm, 6*mm }, { 2, 2, 2 }, { at = { 27*mm, 2*mm, 4*mm } })
  parts = { a, b, nut }
  joints = { interface.contact{ name = "below", between = { a:face "zmax", nut:face "zmin" }, gap = "geometry" }, interface.contact{ name = "above", between = { nut:face "zmax", b:face "zmin" }, gap = "geometry", within = 1*mm } }
  local base = fixed{ a:face "xmin", a:face "xmax", b:face "xmin", b:face "xmax" }
  dt, duration = 2*us, 1000*us
  shock{ load.base_acceleration{ on = base, direction = Z, history = half{ peak = 5000, duration = 200*us } } }
  see(nut:face "zmax", Z) see(at_x(b, 30*mm), Z)
elseif p.scene == 33 then -- a free bar of two metals, struck
  local a, b = box("a", { 6*mm, 6*mm, 50*mm }, { 1, 1, 10 }), box("b", { 6*mm, 6*mm, 50*mm }, { 1, 1, 10 }, { of = aluminium, at = { 0, 0, 50*mm } })
  parts, dt, duration = { a, b }, 2*us, 1500*us
  bonded(a:face "zmax", b:face "zmin")
  shock{ load.traction{ on = a:face "zmin", x = half{ peak = 5*MPa, duration = 60*us }, z = half{ peak = 10*MPa, duration = 60*us } } }
  see(b:face "zmax", X) see(b:face "zmax", Z)
elseif p.scene == 34 then -- a damped plate held along one edge, struck
  local a = box("a", { 60*mm, 40*mm, 3*mm }, { 12, 8, 1 }, { of = damped })
  parts, dt, duration = { a }, 5*us, 5*ms
  fixed(a:face "xmin")
  shock{ load.force{ on = at_x(a, 60*mm, 0), z = half{ peak = 50, duration = 200*us } } }
  see(at_x(a, 60*mm, 40*mm), Z) see(at_x(a, 30*mm, 0), Z)
elseif p.scene == 35 then -- a damped cantilever on a shaken base
  local a = box("a", { 80*mm, 6*mm, 4*mm }, { 16, 2, 1 }, { of = damped })
  parts, dt, duration = { a }, 5*us, 8*ms
  shock{ load.base_acceleration{ on = fixed(a:face "xmin"), direction = { 0, 0.5, 1 }, history = half{ peak = 3000, duration = 300*us } } }
  see(a:face "xmax", Z) see(at_x(a, 40*mm), Y)
elseif p.scene >= 21 then -- static: a square bar twisted (21, 22, 23) or bent (24, 25), one, two or four cells across
  local across = ({ 1, 2, 4, 1, 2 })[p.scene - 20]
  local a = box("a", { 60*mm, 8*mm, 8*mm }, { p.scene < 24 and 20 or 8, across, across })
  parts = { a }
  fixed(a:face "xmin")
  steps[1] = step.static{ name = "load", loads = { p.scene < 24 and load.torque{ on = a:face "xmax", axis = X, history = 10 } or load.force{ on = a:face "xmax", z = 100 } } }
end

local outputs = { output.energy{} }
for i, place in ipairs(places) do
  outputs[#outputs+1] = output.history{ name = "v" .. i, on = place[1], direction = place[2], quantity = "velocity" }
  if foot then outputs[#outputs+1] = output.history{ name = "foot " .. i, on = foot, direction = place[2], quantity = "velocity" } end
  local a = output.history{ name = "a" .. i, on = place[1], direction = place[2], quantity = "acceleration" }
  outputs[#outputs+1] = a
  outputs[#outputs+1] = output.srs{ name = "s" .. i, of = a, from = math.max(1 / duration, p.scene > 12 and 200 or 1000), to = math.min(100e3, 0.25 / dt / (p.scene > 12 and 4 or 1)), per_octave = 6 }
end
-- One scheme and one mass whatever the time step.
problem{ name = "scene " .. p.scene, solver = solver.latin{ integration = "implicit" }, substructures = parts, interfaces = joints, supports = supports, steps = steps, outputs = outputs }:run{}
