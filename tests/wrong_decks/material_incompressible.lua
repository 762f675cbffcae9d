local rubber = material.elastic{ name = "rubber", young = 5*MPa, poisson = 0.5, density = 1100 }
