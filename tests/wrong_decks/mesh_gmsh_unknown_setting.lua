local file = mesh.gmsh{ file = "block.geo", set = { sze = 2*mm } }
