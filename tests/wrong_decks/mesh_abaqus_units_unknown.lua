local file = mesh.abaqus{ file = "plate.inp", units = "mm N" }
