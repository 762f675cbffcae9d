local s = solver.latin{ pieces = "auto" }
