local mu = -1
assert(mu > 0, "mu must be positive")
