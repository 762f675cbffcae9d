local low = substructure.superelement{ name = "low" }
