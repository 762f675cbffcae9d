local s = solver.latin{ tolerance = 1 }
