local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local screw = bolt.hex{ name = "screw", size = "M6", grip = 12*mm, material = steel }
local step1 = load.preload{ on = screw.shaft, force = 8*kN }
