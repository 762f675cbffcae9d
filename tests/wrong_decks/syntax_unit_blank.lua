local cube = mesh.box{ size = { 5*mm, 20.5 mm, 5*mm }, cells = { 1, 1, 1 } }
