local s = solver.latin{ window = "half" }
