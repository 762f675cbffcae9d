local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping_ratio = { 0.01, 0.09 }, damping_frequency = { 1*kHz, 2*kHz } }
