local low = substructure.superelement{ name = "low", file = "element.json", velocity = { 0, 0, 1 } }
