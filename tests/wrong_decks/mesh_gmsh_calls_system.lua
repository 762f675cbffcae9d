local file = mesh.gmsh{ file = "calls_system.geo" }
