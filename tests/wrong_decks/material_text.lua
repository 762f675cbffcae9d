local steel = material.elastic{ name = "steel", young = "210e9", poisson = 0.3, density = 7800 }
