local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 }, order = 3 }
