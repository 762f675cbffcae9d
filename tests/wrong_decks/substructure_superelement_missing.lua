local low = substructure.superelement{ name = "low", file = "elements.json" }
