local file = mesh.abaqus{ file = "skin.inp", unit = mm }
