// A rod of radius 5 mm from (0, 0, 0) along (3, 2, 6) / 7, 40 mm long.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 40*3/7, 40*2/7, 40*6/7, 5};
Physical Volume("rod") = {1};
Physical Surface("side") = {1};
Physical Surface("top") = {2};
Physical Surface("foot") = {3};
