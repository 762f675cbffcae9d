local cube = mesh.box{ size = { 1, 1, 1 }, cells = { 10000, 10000, 10000 } }
