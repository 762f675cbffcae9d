local steel = material.elastic{ name = "steel", young = 70*mm, poisson = 0.3, density = 7800 }
