// A punch with a round lower side: 45 degrees of a cylinder of radius 0.5 mm, n facets along the arc.
DefineConstant[ n = 3 ];
SetFactory("OpenCASCADE");
R = 0.5; a = Pi/8; s = R*Sin(a); h = R - R*Cos(a);
Point(1) = {-s, 0, h}; Point(2) = {s, 0, h}; Point(3) = {s, 0, 0.4}; Point(4) = {-s, 0, 0.4}; Point(5) = {0, 0, R};
Circle(1) = {1, 5, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 3} = n + 1; Transfinite Curve{2, 4} = n + 1; Transfinite Surface{1}; Recombine Surface{1};
v[] = Extrude{0, 0.38, 0}{ Surface{1}; Layers{3}; Recombine; };
Physical Volume("punch") = {v[1]}; Physical Surface("round") = {v[2]}; Physical Surface("top") = {v[4]}; Physical Surface("side1") = {1}; Physical Surface("side2") = {v[0]};
