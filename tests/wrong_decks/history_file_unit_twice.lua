local h = history.file{ file = "shock_in_g.csv", unit = g0 }
