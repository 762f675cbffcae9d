local low = substructure.superelement{ name = "low", file = "element.json" }
local step = step.static{ name = "rest", increments = 1, loads = { load.force{ on = low:face "zmax", z = 1 } } }
problem{ name = "p", substructures = { low }, steps = { step }, outputs = { output.history{ name = "h", on = low:face "zmax", quantity = "stress" } } }:run{}
