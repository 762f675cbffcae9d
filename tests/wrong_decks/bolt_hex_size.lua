local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local bolt = bolt.hex{ name = "bolt", size = "M7", grip = 12*mm, material = steel }
