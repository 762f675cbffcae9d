local low = substructure.superelement{ name = "low", stiffness = "element_stiffness.mtx" }
