local low = substructure.superelement{ name = "low", file = "element.json", mass = "element_mass.mtx" }
