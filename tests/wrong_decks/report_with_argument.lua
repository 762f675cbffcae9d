local file = mesh.abaqus{ file = "plate.inp", units = "mm t s" }
print(file:report "all")
