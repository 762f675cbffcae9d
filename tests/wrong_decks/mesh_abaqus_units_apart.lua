local file = mesh.abaqus{ file = "plate.inp", unit = 1, units = "mm t s" }
