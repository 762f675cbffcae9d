// A block of one hexahedron.
DefineConstant[ size = {0.01, Name "size"} ];
Point(1) = {0, 0, 0};
line[] = Extrude {size, 0, 0} { Point{1}; Layers{1}; };
square[] = Extrude {0, size, 0} { Line{line[1]}; Layers{1}; Recombine; };
block[] = Extrude {0, 0, size} { Surface{square[1]}; Layers{1}; Recombine; };
Physical Volume("block") = {block[1]};
Physical Surface("bottom") = {square[1]};
