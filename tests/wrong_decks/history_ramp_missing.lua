local h = history.ramp{ to = 3*MPa }
