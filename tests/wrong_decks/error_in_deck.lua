error("mu must be positive")
