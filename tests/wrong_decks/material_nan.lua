local steel = material.elastic{ name = "steel", young = 0/0, poisson = 0.3, density = 7800 }
