local file = mesh.gmsh{ file = "nowhere.geo" }
