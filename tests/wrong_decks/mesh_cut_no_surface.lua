local file = mesh.abaqus{ file = "plate.inp", units = "mm t s" }
local halves = file:parts "*"[1]:cut "MIDDLE"
