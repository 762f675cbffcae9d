local low = substructure.superelement{ name = "low", file = "furlongs.csv" }
