local cube = mesh.box{ size = { 0.02m, 0.1, 0.1 }, cells = { 1, 1, 1 } }
