local file = mesh.abaqus{ file = "plate.inp", units = "mm t s" }
local plate = substructure{ name = "plate", mesh = file:part "PLATE", material = file:material "STEEL" }
local foot = plate:region "FEET"
