local ply = material.orthotropic{ name = "ply", e1 = 1*GPa, e2 = 10*GPa, e3 = 9*GPa, nu12 = 0.5, nu13 = 0.25, nu23 = 0.45, g12 = 5*GPa, g13 = 4*GPa, g23 = 3*GPa, density = 1600 }
