local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local screw = bolt.hex{ name = "screw", size = "M6", grip = 12*mm, material = steel }
local screws = pattern.line{ n = 2, step = { 20*mm, 0, 0 }, of = screw }
local step1 = load.preload{ on = screws.shank, force = 8*kN }
