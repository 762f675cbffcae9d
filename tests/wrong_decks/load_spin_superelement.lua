local low = substructure.superelement{ name = "low", file = "element.json" }
local step = step.static{ name = "spin", increments = 1, loads = { load.spin{ speed = 500, axis = { 0, 0, 1 } } } }
problem{ name = "p", substructures = { low }, steps = { step } }:run{}
