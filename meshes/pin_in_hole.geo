// A pin in the hole of a plate, the half y > 0 of both, one cell thick along z: hexahedra, each meshed by itself.
//
//   body = 1: volume pin; pin.round, pin.y (y = 0), pin.lower (z = 0)
//   body = 2: volume plate, a disc with the hole in its middle; plate.hole, plate.rim, plate.y, plate.lower
//
// n cells along a quarter of the pin or the hole.

mm = 0.001;
DefineConstant[ body = {1, Choices{1="pin", 2="plate"}, Name "Parameters/Body"},
                n = {20, Min 2, Max 1000, Name "Parameters/Cells a quarter"},
                radius = {10*mm, Min 1*mm, Name "Parameters/Radius of the hole [m]"},
                rim = {300*mm, Min 2*mm, Name "Parameters/Radius of the plate [m]"},
                thick = {1*mm, Min 0.001*mm, Name "Parameters/Thickness [m]"} ];

Point(1) = {0, 0, 0};
Point(2) = {radius, 0, 0};
Point(3) = {0, radius, 0};
Point(4) = {-radius, 0, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Transfinite Curve{1, 2} = n + 1;
If (body == 1)
  Line(3) = {4, 1};
  Line(4) = {1, 2};
  Transfinite Curve{3, 4} = Round(n*2/Pi) + 1;
  Curve Loop(1) = {1, 2, 3, 4};
  Plane Surface(1) = {1};
  Recombine Surface{1};
  out[] = Extrude {0, 0, thick} { Surface{1}; Layers{1}; Recombine; };
  Physical Volume("pin") = {out[1]};
  Physical Surface("pin.round") = {out[2], out[3]};
  Physical Surface("pin.y") = {out[4], out[5]};
  Physical Surface("pin.lower") = {1};
Else
  Point(5) = {rim, 0, 0};
  Point(6) = {0, rim, 0};
  Point(7) = {-rim, 0, 0};
  Circle(3) = {5, 1, 6};
  Circle(4) = {6, 1, 7};
  Line(5) = {2, 5};
  Line(6) = {3, 6};
  Line(7) = {4, 7};
  Transfinite Curve{3, 4} = n + 1;
  layers = Round(Log(rim/radius)*n*2/Pi);   // square cells
  Transfinite Curve{5, 6, 7} = layers + 1 Using Progression (rim/radius)^(1/layers);
  Curve Loop(1) = {5, 3, -6, -1};
  Curve Loop(2) = {6, 4, -7, -2};
  Plane Surface(1) = {1};
  Plane Surface(2) = {2};
  Transfinite Surface{1, 2};
  Recombine Surface{1, 2};
  out[] = Extrude {0, 0, thick} { Surface{1, 2}; Layers{1}; Recombine; };  // of each: top, volume, then the sides along the loop
  Physical Volume("plate") = {out[1], out[7]};
  Physical Surface("plate.lower") = {1, 2};
  Physical Surface("plate.y") = {out[2], out[10]};
  Physical Surface("plate.rim") = {out[3], out[9]};
  Physical Surface("plate.hole") = {out[5], out[11]};
EndIf
