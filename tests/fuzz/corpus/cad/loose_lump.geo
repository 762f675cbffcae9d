// Two hexahedra that do not touch, one volume by name.
For i In {0 : 1}
  p = newp; Point(p) = {0, 0, 0.02 * i};
  line[] = Extrude {0.01, 0, 0} { Point{p}; Layers{1}; };
  square[] = Extrude {0, 0.01, 0} { Line{line[1]}; Layers{1}; Recombine; };
  block[] = Extrude {0, 0, 0.01} { Surface{square[1]}; Layers{1}; Recombine; };
  volume[i] = block[1];
  bottom[i] = square[1];
EndFor
Physical Volume("block") = {volume[0], volume[1]};
Physical Surface("bottom") = {bottom[0]};
