local cube = mesh.box{ size = { 10*mm, 10*mm, 0 }, cells = { 1, 1, 1 } }
