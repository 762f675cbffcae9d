local cube = mesh.box{ size = { 5*m, 1, 1 }, cells = { 1, 1, 1 } }
