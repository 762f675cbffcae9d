local file = mesh.nastran{ file = "wedge.bdf", units = "mm t s" }
