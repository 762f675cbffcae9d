local file = mesh.gmsh{ file = "cells_twice.msh", unit = mm }
