local s = solver.monolithic{}
