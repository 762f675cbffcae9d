local file = mesh.gmsh{ file = "block.geo", size = 4*um }
