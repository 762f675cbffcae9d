local cube = mesh.box{ size = { 20mm, 5*mm, 5*mm }, cells = { 1, 1, 1 } }
