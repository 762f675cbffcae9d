local file = mesh.abaqus{ file = "plate.inp", units = "m kg s" }
local steel = file:material "STEEL"
