solver.explicit{ integration = "two_point" }
