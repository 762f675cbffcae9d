local low = substructure.superelement{ name = "low", stiffness = "spring.pch", mass = "spring.pch", points = "spring.csv" }
