local h = history.haversine{ peak = 80*MPa, length = 15*us }
