local halves = mesh.box{ size = { 0.1, 0.01, 0.01 }, cells = { 5, 1, 1 } }:cut{ normal = { 1, 1, 0 }, at = 0.05 }
