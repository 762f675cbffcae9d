local file = mesh.unv{ file = "cut_off.unv" }
