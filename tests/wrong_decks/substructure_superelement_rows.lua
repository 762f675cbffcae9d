local low = substructure.superelement{ name = "low", stiffness = "element_stiffness.mtx", mass = "element_mass.mtx", points = "element_rows.csv" }
