local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm } }
