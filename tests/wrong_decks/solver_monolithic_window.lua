local s = solver.monolithic{ window = 4 }
