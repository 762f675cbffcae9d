local h = history.half_sine{ peak = 80*MPa, duration = 1500 }
