// A wedge of a ring around the z axis: hexahedra, n_radial, n_around and n_high cells.
//
//   volume wedge; its surfaces: wedge.right (at the angle `from`), wedge.left (at `to`), wedge.inner wedge.outer wedge.bottom wedge.top

DefineConstant[ inner = {0.03, Min 0.001, Max 10, Name "Parameters/Inner radius [m]"},
                outer = {0.05, Min 0.001, Max 10, Name "Parameters/Outer radius [m]"},
                low = {0, Min -10, Max 10, Name "Parameters/Lowest z [m]"},
                high = {0.01, Min -10, Max 10, Name "Parameters/Highest z [m]"},
                from = {0, Min -360, Max 360, Name "Parameters/From [degrees]"},
                to = {45, Min -360, Max 360, Name "Parameters/To [degrees]"},
                n_radial = {4, Min 1, Max 200, Name "Parameters/Cells across"},
                n_around = {8, Min 1, Max 200, Name "Parameters/Cells around"},
                n_high = {2, Min 1, Max 200, Name "Parameters/Cells in height"} ];

a = from*Pi/180; b = to*Pi/180;
Point(1) = {0, 0, low};
Point(2) = {inner*Cos(a), inner*Sin(a), low};
Point(3) = {outer*Cos(a), outer*Sin(a), low};
Point(4) = {outer*Cos(b), outer*Sin(b), low};
Point(5) = {inner*Cos(b), inner*Sin(b), low};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = n_radial + 1;
Transfinite Curve{2, 4} = n_around + 1;
Transfinite Surface{1} = {2, 3, 4, 5};
Recombine Surface{1};
out[] = Extrude {0, 0, high - low} { Surface{1}; Layers{n_high}; Recombine; };  // top, volume, then the sides along the loop
Physical Volume("wedge") = {out[1]};
Physical Surface("wedge.right") = {out[2]};
Physical Surface("wedge.outer") = {out[3]};
Physical Surface("wedge.left") = {out[4]};
Physical Surface("wedge.inner") = {out[5]};
Physical Surface("wedge.bottom") = {1};
Physical Surface("wedge.top") = {out[0]};
