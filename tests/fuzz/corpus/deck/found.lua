local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.33, density = 2700 }
local plate = substructure{ name = "plate", material = alloy, mesh = mesh.box{ size = { 40*mm, 10*mm, 2*mm }, cells = { 2, 1, 1 } } }
local foot = substructure{ name = "foot", material = alloy, mesh = mesh.box{ size = { 5*mm, 10*mm, 2*mm }, cells = { 1, 1, 1 }, cell = "prism6" }, place = { 0, 0, -2*mm }, integration = "explicit" }
local feet = pattern.line{ of = foot, n = 3, step = { 10*mm, 0, 0 } }
local all = interface.contact{ name = "all", between = "all touching", except = { feet[2] }, friction = 0.1, within = 0.1*mm }
local held = support.fixed{ name = "held", on = { feet[1]:face "zmin", feet[3]:face "zmin" } }
local absorbs = support.absorbing{ name = "absorbs", on = plate:face "xmax" }
local signal = history.file{ file = "shock_in_g.csv" }
local drive = load.base_acceleration{ on = held, direction = { 0, 0, 1 }, history = signal:shifted(1*us) + 2*signal:scaled(0.5) }
local shock = step.dynamic{ name = "shock", duration = 3*us, dt = 0.5*us, loads = { drive, load.torque{ on = plate:face "xmax", axis = { 1, 0, 0 }, history = 1 } } }
local before = output.history{ name = "before", on = feet[1]:face "zmin", quantity = "acceleration" }
local after = output.history{ name = "after", on = plate:face "zmax", quantity = "acceleration" }
local way = output.attenuation{ name = "way", entering = before, leaving = after, from = 10*kHz, to = 100*kHz, q_factor = 10 }
local map = output.srs_field{ name = "map", on = plate:face "zmax", from = 10*kHz, to = 50*kHz, damping = 0.05 }
problem{ name = "found", substructures = { plate, feet }, interfaces = { all }, supports = { held, absorbs }, steps = { shock }, outputs = { before, after, way, map },
  solver = solver.explicit{ penalty = 1, safety = 0.8 } }:run{}
