local file = mesh.abaqus{ file = "plate.inp", units = "mm t s" }
local light = file:material "LIGHT"
