local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 2.5, 1 } }
