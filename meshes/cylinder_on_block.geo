// The lower half of a cylinder on a block, cut by the plane of symmetry x = 0, one cell thick along y: hexahedra, fine where they touch, each meshed by itself.
//
//   body = 1: volume cylinder; cylinder.top, cylinder.x (x = 0), cylinder.ends (y = 0 and y = thick)
//   body = 2: volume block below; block.top, block.bottom, block.x, block.ends
//
// Cells have the size `fine` up to 1.3 half widths of the contact from the origin and grow from there.

mm = 0.001;
DefineConstant[ body = {1, Choices{1="cylinder", 2="block"}, Name "Parameters/Body"},
                radius = {10*mm, Min 1*mm, Name "Parameters/Radius of the cylinder [m]"},
                contact = {0.5*mm, Min 0.01*mm, Name "Parameters/Half width of the contact [m]"},
                fine = {0.05*mm, Min 0.001*mm, Name "Parameters/Cell size at the contact [m]"},
                growth = {0.2, Min 0.05, Max 2, Name "Parameters/Growth of the cell size with the distance"},
                wide = {20*mm, Min 1*mm, Name "Parameters/Depth and half width of the block [m]"},
                thick = {0.1*mm, Min 0.001*mm, Name "Parameters/Thickness [m]"} ];

Point(1) = {0, 0, 0};
If (body == 1)
  Point(2) = {radius, 0, radius};
  Point(3) = {0, 0, radius};
  Circle(1) = {1, 3, 2};
  Line(2) = {2, 3};
  Line(3) = {3, 1};
  Curve Loop(1) = {1, 2, 3};
Else
  Point(2) = {0, 0, -wide};
  Point(3) = {wide, 0, -wide};
  Point(4) = {wide, 0, 0};
  Line(1) = {1, 2};
  Line(2) = {2, 3};
  Line(3) = {3, 4};
  Line(4) = {4, 1};
  Curve Loop(1) = {1, 2, 3, 4};
EndIf
Plane Surface(1) = {1};
Recombine Surface{1};
out[] = Extrude {0, thick, 0} { Surface{1}; Layers{1}; Recombine; };
If (body == 1)
  Physical Volume("cylinder") = {out[1]};
  Physical Surface("cylinder.round") = {out[2]};
  Physical Surface("cylinder.top") = {out[3]};
  Physical Surface("cylinder.x") = {out[4]};
  Physical Surface("cylinder.ends") = {1, out[0]};
Else
  Physical Volume("block") = {out[1]};
  Physical Surface("block.x") = {out[2]};
  Physical Surface("block.bottom") = {out[3]};
  Physical Surface("block.top") = {out[5]};
  Physical Surface("block.ends") = {1, out[0]};
EndIf

// fine + growth*max(0, r - 1.3 contact)
Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g*(Fabs(Sqrt(x*x+z*z)-%g)+Sqrt(x*x+z*z)-%g)", fine, growth/2, 1.3*contact, 1.3*contact);
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
