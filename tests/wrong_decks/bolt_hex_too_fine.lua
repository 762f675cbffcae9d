local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
bolt.hex{ name = "b", size = "M24", grip = 2, material = steel, around = 240, order = 2 }
