local halves = mesh.box{ size = { 0.1, 0.01, 0.01 }, cells = { 5, 1, 1 } }:cut{ normal = { 1, 0, 0 }, at = 0.04 }
local more = halves[2]:cut{ normal = { 1, 0, 0 }, at = 0.08 }
