// A round insert through a skin of 1 mm and a core below it, a pad over both: each meshed by itself, so that none of
// their polygons of the rim where three of them meet is another's.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -10, 0, 0, 11, 8};
Box(2) = {-25, -20, -10, 50, 40, 10};
Box(3) = {-25, -20, 0, 50, 40, 1};
Cylinder(4) = {0, 0, -10, 0, 0, 11, 8};
Cylinder(5) = {0, 0, -10, 0, 0, 11, 8};
BooleanDifference{ Volume{2}; Delete; }{ Volume{4}; Delete; }
BooleanDifference{ Volume{3}; Delete; }{ Volume{5}; Delete; }
Box(6) = {-14, -13, 1, 28, 26, 5};
Physical Volume("insert") = {1};
Physical Volume("core") = {2};
Physical Volume("skin") = {3};
Physical Volume("pad") = {6};
MeshSize{ PointsOf{ Volume{1}; } } = 5;
MeshSize{ PointsOf{ Volume{2}; } } = 7;
MeshSize{ PointsOf{ Volume{3}; } } = 6;
MeshSize{ PointsOf{ Volume{6}; } } = 6;
