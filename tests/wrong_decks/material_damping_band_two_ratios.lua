local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping_ratio = { 0.01, 0.02 }, damping_band = { 100, 10*kHz } }
