// The lower half of a ball on a block, cut by planes of symmetry: fine where they touch, each meshed by itself.
//
//   body = 1: volume ball, a quarter (half = 0) or a half of the hemisphere that stands on the origin; ball.top, cuts ball.x (x = 0), ball.y
//   body = 2: volume block below; block.top, block.bottom, cuts block.x, block.y
//
// Cells have the size `fine` up to 1.3 contact radii from the origin and grow from there.

SetFactory("OpenCASCADE");
mm = 0.001;
DefineConstant[ body = {1, Choices{1="ball", 2="block"}, Name "Parameters/Body"},
                half = {0, Choices{0, 1}, Name "Parameters/Half in place of a quarter"},
                radius = {10*mm, Min 1*mm, Name "Parameters/Radius of the ball [m]"},
                contact = {0.5*mm, Min 0.01*mm, Name "Parameters/Radius of the contact [m]"},
                fine = {0.1*mm, Min 0.001*mm, Name "Parameters/Cell size at the contact [m]"},
                growth = {0.4, Min 0.1, Max 2, Name "Parameters/Growth of the cell size with the distance"},
                wide = {6*mm, Min 1*mm, Name "Parameters/Depth and half width of the block [m]"} ];
e = 1e-4*radius;
far = 3*radius;

If (body == 1)
  // Turned, for its surface's coordinates are singular at the poles, and one would be at the contact.
  Sphere(1) = {0, 0, radius, radius, -half*Pi/2, Pi/2, Pi/2};
  Rotate {{1, 1, 1}, {0, 0, radius}, 2*Pi/3} { Volume{1}; }
  Rotate {{1, 0, 0}, {0, 0, radius}, -Pi/2} { Volume{1}; }
  Physical Volume("ball") = {1};
  top[] = Surface In BoundingBox{-far, -e, radius - e, far, far, radius + e};
  Physical Surface("ball.top") = top[];
Else
  Box(1) = {-half*wide, 0, -wide, (1 + half)*wide, wide, wide};
  Physical Volume("block") = {1};
  top[] = Surface In BoundingBox{-far, -e, -e, far, far, e};
  bottom[] = Surface In BoundingBox{-far, -e, -wide - e, far, far, -wide + e};
  Physical Surface("block.top") = top[];
  Physical Surface("block.bottom") = bottom[];
EndIf
x[] = Surface In BoundingBox{-e, -e, -far, e, far, far};
y[] = Surface In BoundingBox{-far, -e, -far, far, e, far};
If (body == 1)
  If (half == 0)
    Physical Surface("ball.x") = x[];
  EndIf
  Physical Surface("ball.y") = y[];
Else
  If (half == 0)
    Physical Surface("block.x") = x[];
  EndIf
  Physical Surface("block.y") = y[];
EndIf

// fine + growth*max(0, r - 1.3 contact)
Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g*(Fabs(Sqrt(x*x+y*y+z*z)-%g)+Sqrt(x*x+y*y+z*z)-%g)", fine, growth/2, 1.3*contact, 1.3*contact);
Background Field = 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
