// A quarter of the parts of bolted_flanges.geo (x > 0, y > 0), one at a time: tetrahedra, fine at the edges of what touches.
//
//   body = 1 lower, 2 upper, 3 rod, 4 head, 5 nut: a volume of that name. Dimensions as there.
//
// Cells have the size `edge` at the circles where head, nut, rod and flanges end on each other and grow by `growth` a length up to `size`.

SetFactory("OpenCASCADE");
mm = 0.001;
DefineConstant[ body = {1, Choices{1="lower", 2="upper", 3="rod", 4="head", 5="nut"}, Name "Parameters/Body"},
                size = {4*mm, Min 0.5*mm, Max 10*mm, Name "Parameters/Cell size [m]"},
                edge = {1*mm, Min 0.02*mm, Max 10*mm, Name "Parameters/Cell size at the edges [m]"},
                growth = {0.35, Min 0.05, Max 2, Name "Parameters/Growth of the cell size with the distance"} ];

rod_radius = 6*mm;
hole_radius = 6.75*mm;
head_radius = 9.5*mm;
half_width = 25*mm;
thickness = 14*mm;
cap = 8*mm;

If (body <= 2)
  Box(1) = {0, 0, (body - 1)*thickness, half_width, half_width, thickness};
  Cylinder(2) = {0, 0, (body - 1)*thickness, 0, 0, thickness, hole_radius, Pi/2};
  BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
  // The circle on which nut or head ends: what is held or pulled begins there.
  Circle(1000) = {0, 0, (body - 1)*2*thickness, head_radius, 0, Pi/2};
  BooleanFragments{ Volume{1}; Delete; }{ Curve{1000}; Delete; }
EndIf
If (body == 3)
  Cylinder(1) = {0, 0, 0, 0, 0, 2*thickness, rod_radius, Pi/2};
EndIf
If (body == 4)
  Cylinder(1) = {0, 0, 2*thickness, 0, 0, cap, head_radius, Pi/2};
EndIf
If (body == 5)
  Cylinder(1) = {0, 0, -cap, 0, 0, cap, head_radius, Pi/2};
EndIf
all[] = Volume{:};
If (body == 1)
  Physical Volume("lower") = all[];
ElseIf (body == 2)
  Physical Volume("upper") = all[];
ElseIf (body == 3)
  Physical Volume("rod") = all[];
ElseIf (body == 4)
  Physical Volume("head") = all[];
Else
  Physical Volume("nut") = all[];
EndIf

// Distance to the circle of radius rho at height h -> a field.
Macro FineAtCircle
  Field[n_fields] = MathEval;
  Field[n_fields].F = Sprintf("%g + %g*Sqrt((Sqrt(x*x+y*y)-%g)^2+(z-%g)^2)", edge, growth, rho, h);
  sizes[] += n_fields;
  n_fields += 1;
Return
n_fields = 1; sizes[] = {};
For h In {0:2*thickness:2*thickness}
  rho = rod_radius; Call FineAtCircle;
  rho = hole_radius; Call FineAtCircle;
  rho = head_radius; Call FineAtCircle;
EndFor
Field[n_fields] = MathEval;
Field[n_fields].F = Sprintf("%g", size);
sizes[] += n_fields;
Field[n_fields + 1] = Min;
Field[n_fields + 1].FieldsList = {sizes[]};
Background Field = n_fields + 1;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
