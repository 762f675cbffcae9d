local ply = material.orthotropic{ name = "ply", e1 = 140*GPa, e2 = 10*GPa, e3 = 9*GPa, nu12 = 0.9, nu13 = 0.9, nu23 = 1, g12 = 5*GPa, g13 = 4*GPa, g23 = 3*GPa, density = 1600 }
