local file = mesh.abaqus{ file = "plate.inp", unit = mm }
local steel = file:material "STEEL"
