local file = mesh.abaqus{ file = "plate.inp", unit = mm }
local plate = file:part "PLATES"
