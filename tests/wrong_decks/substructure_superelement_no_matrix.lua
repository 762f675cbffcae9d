local low = substructure.superelement{ name = "low", stiffness = "element.json", mass = "element_mass.mtx", points = "element_points.csv" }
