local s = solver.latin{ pieces = "many" }
