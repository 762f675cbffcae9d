local s = solver.explicit{ integration = "onepoint" }
