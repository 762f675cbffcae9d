local n = 3
n += 1
