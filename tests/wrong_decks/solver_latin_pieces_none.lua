local s = solver.latin{ pieces = 0 }
