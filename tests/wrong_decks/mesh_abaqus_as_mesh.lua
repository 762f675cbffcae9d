local file = mesh.abaqus{ file = "plate.inp", units = "mm t s" }
local plate = substructure{ name = "plate", mesh = file, material = file:material "STEEL" }
