local v = output.vtk{ frames = 10, fields = { "displacment" } }
