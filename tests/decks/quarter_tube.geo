// quarter of a thick ring, thin slice: n cells through the wall, 2 n around
DefineConstant[ n = 8 ];
a = 0.020; b = 0.030; h = 0.002;
Point(1) = {0,0,0};
Point(2) = {a,0,0}; Point(3) = {b,0,0}; Point(4) = {0,b,0}; Point(5) = {0,a,0};
Line(1) = {2,3}; Circle(2) = {3,1,4}; Line(3) = {4,5}; Circle(4) = {5,1,2};
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
Transfinite Curve{1,3} = n+1; Transfinite Curve{2,4} = 2*n+1;
Transfinite Surface{1}; Recombine Surface{1};
v[] = Extrude{0,0,h}{ Surface{1}; Layers{1}; Recombine; };
Physical Volume("ring") = {v[1]};
Physical Surface("bore") = {v[5]};
Physical Surface("x0") = {v[4]};
Physical Surface("y0") = {v[2]};
Physical Surface("ends") = {1, v[0]};
