local low = substructure.superelement{ name = "low", stiffness = "spring.pch", mass = "spring.pch", points = "spring.csv", units = "mm t s", total_mass = 0.004 }
