local low = substructure.superelement{ name = "low", file = "element.json" }
local shock = step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { load.force{ on = low:face "zmax", z = 1 } } }
problem{ name = "p", substructures = { low }, steps = { shock }, solver = solver.explicit{} }:run{}
