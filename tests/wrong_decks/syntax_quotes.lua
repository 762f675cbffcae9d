local steel = material.elastic{ name = “steel”, young = 210*GPa, poisson = 0.3, density = 7800 }
