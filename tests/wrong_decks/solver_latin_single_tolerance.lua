local tight = solver.latin{ precision = "single", tolerance = 1e-9 }
