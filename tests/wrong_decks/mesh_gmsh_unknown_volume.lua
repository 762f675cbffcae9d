local file = mesh.gmsh{ file = "block.geo" }
local m = file:volume "blok"
