// Two square flanges held by one bolt: five bodies of hexahedra that meet at coincident nodes.
//
//                          head_radius
//                         |<--------->|
//                   +-----------------------+ - - - - - - - - - -   z = 2 thickness + cap
//                   |          head         |
//                   |    :             :    |
//   +---------------+--+-:-------------:-+--+---------------+ - -   z = 2 thickness
//   |                  | |             | |                  |
//   |      upper       | |             | |                  |
//   |                  | |     rod     | |                  |
//   +------------------+ |             | +------------------+ - -   z = thickness
//   |                  | |             | |                  |
//   |      lower       | |             | |                  |
//   |                  | |             | |                  |
//   +---------------+--+-:-------------:-+--+---------------+ - -   z = 0
//                   |    :             :    |
//                   |          nut          |
//                   +-----------------------+ - - - - - - - - - -   z = -cap
//                                |<--->| rod_radius
//                                |<----->| hole_radius
//
// The rod leaves the flanges clear; it meets the head and the nut on disks, which meet the flanges on annuli.
// Bodies are separate in the CAD sense: where they touch, each has its own surface with the same divisions.
//
// Volumes    lower upper rod head nut
// Surfaces   lower.base (bottom but for the nut's annulus)  lower.nut  lower.upper  lower.side
//            upper.lower  upper.head  upper.top (top but for the head's annulus)
//            head.upper  head.rod_end  rod.head_end  rod.nut_end  nut.rod_end  nut.lower
//
// Section of a flange: rings around the hole up to a square, then blocks.     Section of the bolt:
//
//      +-----+---------+-----+
//      |     |         |     |                                                      .-'''-.
//      +-----+---------+-----+                                                    .'\     /'.
//      |     | \ .-. / |     |                                                   |   +---+   |
//      |     |  (   )  |     |                                                   |   |   |   |
//      |     | / '-' \ |     |                                                   |   +---+   |
//      +-----+---------+-----+                                                    './     \.'
//      |     |         |     |                                                      '-...-'
//      +-----+---------+-----+
//
// size (m) is the one parameter:
//   size                          4 mm      3 mm      2 mm    1.5 mm      1 mm
//   cells                         1408      2955     10296     24301     80368
//   degrees of freedom            6618     12624     39579     88224    273885

SetFactory("OpenCASCADE");
DefineConstant[ size = {0.004, Min 0.0005, Max 0.008, Name "Parameters/Cell size [m]"} ];

mm = 0.001;
rod_radius = 6*mm;      // M12
hole_radius = 6.75*mm;  // medium fit
head_radius = 9.5*mm;
core_radius = 4.1*mm;   // corner of the square in the middle of the rod
block = 12*mm;          // half width of the square around the rings
half_width = 25*mm;     // flange 50 mm x 50 mm
thickness = 14*mm;      // of each flange
cap = 8*mm;             // of the head and of the nut

// Divisions: along a quarter of a turn, across each ring, across the outer blocks, along z.
n_quarter = Max(2, Round(16*mm/size));
n_core = Max(1, Round(2.5*mm/size));
n_clearance = Max(1, Round((hole_radius - rod_radius)/size));
n_seat = Max(1, Round((head_radius - hole_radius)/size));
n_around = Max(1, Round(5*mm/size));
n_block = Max(1, Round((half_width - block)/size));
n_thickness = Max(1, Round(thickness/size));
n_rod = Max(2, Round(2*thickness/size));
n_cap = Max(1, Round(cap/size));

// Four corners at 45 degrees and more, distance rho from the axis at height z -> corners[].
Macro Corners
  corners[] = {};
  For i In {0:3}
    p = newp;
    Point(p) = {rho*Cos(Pi/4 + i*Pi/2), rho*Sin(Pi/4 + i*Pi/2), z};
    corners[] += p;
  EndFor
Return

// Arcs about `centre`, or straight edges where `straight` is 1, from each corner to the next -> corners[] edges[].
Macro Loop4
  Call Corners;
  edges[] = {};
  For i In {0:3}
    c = newc;
    If (straight)
      Line(c) = {corners[i], corners[(i + 1)%4]};
    Else
      Circle(c) = {corners[i], centre, corners[(i + 1)%4]};
    EndIf
    Transfinite Curve {c} = n_quarter + 1;
    edges[] += c;
  EndFor
Return

// Four faces between the last loop, kept in inner_corners[] inner_edges[], and one of corner distance rho,
// with n_across divisions -> faces[]; the new loop becomes the last one.
Macro Ring
  Call Loop4;
  spokes[] = {};
  For i In {0:3}
    c = newc;
    Line(c) = {inner_corners[i], corners[i]};
    Transfinite Curve {c} = n_across + 1;
    spokes[] += c;
  EndFor
  faces[] = {};
  For i In {0:3}
    l = newll;
    Curve Loop(l) = {inner_edges[i], spokes[(i + 1)%4], -edges[i], -spokes[i]};
    s = news;
    Plane Surface(s) = {l};
    faces[] += s;
  EndFor
  inner_corners[] = corners[];
  inner_edges[] = edges[];
Return

// A disk of the rod's radius at height z -> disk[] (5 faces); leaves its rim as the last loop.
Macro RodSection
  centre = newp;
  Point(centre) = {0, 0, z};
  rho = core_radius; straight = 1;
  Call Loop4;
  l = newll;
  Curve Loop(l) = edges[];
  core = news;
  Plane Surface(core) = {l};
  inner_corners[] = corners[];
  inner_edges[] = edges[];
  rho = rod_radius; straight = 0; n_across = n_core;
  Call Ring;
  disk[] = {core, faces[]};
Return

// A disk with the rings of the head or the nut at height z -> disk[] clearance[] seat[] (5 + 4 + 4 faces).
Macro CapSection
  Call RodSection;
  rho = hole_radius; n_across = n_clearance;
  Call Ring;
  clearance[] = faces[];
  rho = head_radius; n_across = n_seat;
  Call Ring;
  seat[] = faces[];
Return

// A flange's section at height z -> seat[] (4 faces under the head or nut), rest[] (12 faces).
Macro FlangeSection
  centre = newp;
  Point(centre) = {0, 0, z};
  rho = hole_radius; straight = 0;
  Call Loop4;
  inner_corners[] = corners[];
  inner_edges[] = edges[];
  rho = head_radius; n_across = n_seat;
  Call Ring;
  seat[] = faces[];
  rho = Sqrt(2)*block; straight = 1; n_across = n_around;
  Call Ring;
  rest[] = faces[];

  // A block beyond each edge i of the square: its far corners are before[i] and after[i].
  before[] = {}; after[] = {}; to_before[] = {}; to_after[] = {};
  For i In {0:3}
    dx = (half_width - block)*Cos(Pi/2 + i*Pi/2);
    dy = (half_width - block)*Sin(Pi/2 + i*Pi/2);
    moved[] = Translate {dx, dy, 0} { Duplicata { Point{inner_corners[i], inner_corners[(i + 1)%4]}; } };
    before[] += moved[0];
    after[] += moved[1];
    c = newc;
    Line(c) = {inner_corners[i], before[i]};
    Line(c + 1) = {inner_corners[(i + 1)%4], after[i]};
    Line(c + 2) = {before[i], after[i]};
    Transfinite Curve {c, c + 1} = n_block + 1;
    Transfinite Curve {c + 2} = n_quarter + 1;
    to_before[] += c;
    to_after[] += c + 1;
    l = newll;
    Curve Loop(l) = {inner_edges[i], c + 1, -(c + 2), -c};
    s = news;
    Plane Surface(s) = {l};
    rest[] += s;
  EndFor

  // A block at each corner i, between the blocks of the edges i - 1 and i.
  For i In {0:3}
    j = (i + 3)%4;
    p = newp;
    Point(p) = {Sqrt(2)*half_width*Cos(Pi/4 + i*Pi/2), Sqrt(2)*half_width*Sin(Pi/4 + i*Pi/2), z};
    c = newc;
    Line(c) = {after[j], p};
    Line(c + 1) = {before[i], p};
    Transfinite Curve {c, c + 1} = n_block + 1;
    l = newll;
    Curve Loop(l) = {to_after[j], c, -(c + 1), -to_before[i]};
    s = news;
    Plane Surface(s) = {l};
    rest[] += s;
  EndFor
Return

// The faces section[] raised by `height` in `n_layers` -> tops[] (in their order), bodies[].
Macro Raise
  Transfinite Surface {section[]};
  Recombine Surface {section[]};
  raised[] = Extrude {0, 0, height} { Surface{section[]}; Layers{n_layers}; Recombine; };
  tops[] = {}; bodies[] = {};
  For i In {0:#section[] - 1}
    tops[] += raised[6*i];
    bodies[] += raised[6*i + 1];
  EndFor
Return

// Lower flange.
z = 0;
Call FlangeSection;
section[] = {seat[], rest[]}; height = thickness; n_layers = n_thickness;
Call Raise;
Physical Volume("lower") = bodies[];
Physical Surface("lower.nut") = seat[];
Physical Surface("lower.base") = rest[];
Physical Surface("lower.upper") = tops[];
e = 0.01*mm;
Physical Surface("lower.side") = {
  Surface In BoundingBox{-half_width - e, -half_width - e, -e, -half_width + e, half_width + e, thickness + e},
  Surface In BoundingBox{half_width - e, -half_width - e, -e, half_width + e, half_width + e, thickness + e},
  Surface In BoundingBox{-half_width - e, -half_width - e, -e, half_width + e, -half_width + e, thickness + e},
  Surface In BoundingBox{-half_width - e, half_width - e, -e, half_width + e, half_width + e, thickness + e} };

// Upper flange.
z = thickness;
Call FlangeSection;
section[] = {seat[], rest[]}; height = thickness; n_layers = n_thickness;
Call Raise;
Physical Volume("upper") = bodies[];
Physical Surface("upper.lower") = section[];
Physical Surface("upper.head") = tops[{0:3}];
Physical Surface("upper.top") = tops[{4:15}];

// Rod.
z = 0;
Call RodSection;
section[] = disk[]; height = 2*thickness; n_layers = n_rod;
Call Raise;
Physical Volume("rod") = bodies[];
Physical Surface("rod.nut_end") = section[];
Physical Surface("rod.head_end") = tops[];

// Head.
z = 2*thickness;
Call CapSection;
section[] = {disk[], clearance[], seat[]}; height = cap; n_layers = n_cap;
Call Raise;
Physical Volume("head") = bodies[];
Physical Surface("head.rod_end") = disk[];
Physical Surface("head.upper") = seat[];

// Nut: its faces of interest are the upper ones.
z = -cap;
Call CapSection;
section[] = {disk[], clearance[], seat[]}; height = cap; n_layers = n_cap;
Call Raise;
Physical Volume("nut") = bodies[];
Physical Surface("nut.rod_end") = tops[{0:4}];
Physical Surface("nut.lower") = tops[{9:12}];
