local low = substructure.superelement{ name = "low", file = "element.json" }
local step = step.static{ name = "rest", increments = 1, loads = { load.gravity{ z = -9.81 } } }
problem{ name = "p", substructures = { low }, steps = { step } }:run{}
