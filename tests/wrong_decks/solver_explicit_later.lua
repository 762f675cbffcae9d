local s = solver.explicit{}
