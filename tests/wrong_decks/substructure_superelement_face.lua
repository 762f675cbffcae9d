local low = substructure.superelement{ name = "low", file = "element.json" }
local top = low:face "zmin"
