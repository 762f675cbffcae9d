local length = 20*cm
