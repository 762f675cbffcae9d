local h = history.pulse{ peak = 80*MPa, rise = 0, hold = 0, fall = 0 }
