local file = mesh.gmsh{ file = "two_orders.msh" }
