// A square bar along z in n slices of one square cell, cut into prisms or tetrahedra: for orders of convergence.
//
//   +--+--+--+--+--+--+
//   |  |  |  |  |  |  |  -> z
//   +--+--+--+--+--+--+
//
// Volume     bar
// Surfaces   zmin zmax xmin xmax ymin ymax
// cells      0 tetrahedra, 1 prisms
DefineConstant[ n = {20, Min 1, Name "Parameters/Slices"}, cells = {0, Min 0, Max 1, Name "Parameters/Cells"} ];

mm = 0.001;
side = 5*mm;
length = 50*mm;

Point(1) = {0, 0, 0};
Point(2) = {side, 0, 0};
Point(3) = {side, side, 0};
Point(4) = {0, side, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1, 2, 3, 4} = 2;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface {1};
If (cells == 1)
  out[] = Extrude {0, 0, length} { Surface{1}; Layers{n}; Recombine; };
Else
  out[] = Extrude {0, 0, length} { Surface{1}; Layers{n}; };
EndIf
Physical Volume("bar") = {out[1]};
Physical Surface("zmin") = {1};
Physical Surface("zmax") = {out[0]};
Physical Surface("ymin") = {out[2]};
Physical Surface("xmax") = {out[3]};
Physical Surface("ymax") = {out[4]};
Physical Surface("xmin") = {out[5]};
