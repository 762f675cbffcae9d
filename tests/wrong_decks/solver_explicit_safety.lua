local s = solver.explicit{ safety = 3 }
