// A box of electronics on a bracket with four bolts M6: bodies of hexahedra that meet at coincident nodes.
//
//        +--------------------------+            box      floor with four holes, walls and a lid
//        |                          |            bracket  plate with the same holes, held at its two ends (xmin, xmax)
//        |   +------------------+   |            washer   ring of 3.3 to 6 mm
//     _h_|   |                  |   |_h_         head     cylinder of 5 mm
//    w===+---+------------------+---+===w        shank    cylinder of 3 mm, through washer, floor and bracket
//    +-||--------------------------------||-+    nut      cylinder of 5 mm
//    | ||            bracket             || |
//    +-||--------------------------------||-+
//      nut                              nut
//
// Round parts are rings of 4 x `around` cells around their axis. Bolt parts are drawn once, around the origin; `box` 100 mm
// above its place, `bracket` 200 mm: the deck brings all together with `place`. The joint between floor and bracket is z = 0.
//
// Surfaces   box.lower box.upper box.lid bracket.upper bracket.lower bracket.ends, and of each bolt part: lower, upper

DefineConstant[ around = {2, Min 1, Max 8, Name "Parameters/Cells in a quarter of a ring"},
                layers = {1, Min 1, Max 8, Name "Parameters/Cells through the floor; twice as many through the bracket"} ];

mm = 0.001;
floor_height = 5*mm; bracket_height = 10*mm; washer_height = 1.6*mm; head_height = 4*mm; nut_height = 5*mm;

// Lines of blocks along x and y; the blocks between -49 and -31 and so on have a bolt in their middle.
x[] = {-55*mm, -49*mm, -31*mm, -28*mm, 28*mm, 31*mm, 49*mm, 55*mm};
n_x[] = {1, around, 1, 3*around, 1, around, 1};
y[] = {-40*mm, -34*mm, -16*mm, -13*mm, 13*mm, 16*mm, 34*mm, 40*mm};
n_y[] = {1, around, 1, 2*around, 1, around, 1};
nx = #n_x[];
ny = #n_y[];

// Rings around (cx, cy, z) with the radii r[] and n_r[] cells across each; outside of the last of them lies the square with corners
// corner[] and sides side[] (from corner k to the next) where to_square is 1; the inside of the first is filled where has_core is 1.
Macro Rings
  centre = newp; Point(centre) = {cx, cy, z};
  If (has_core)
    core[] = {};
    For k In {0:3}
      p = newp; Point(p) = {cx + 0.5*r[0]*Cos((k - 2.5)*Pi/2 + Pi/2), cy + 0.5*r[0]*Sin((k - 2.5)*Pi/2 + Pi/2), z}; core[] += p;
    EndFor
    core_side[] = {};
    For k In {0:3}
      c = newc; Line(c) = {core[k], core[(k + 1) % 4]}; Transfinite Curve {c} = around + 1; core_side[] += c;
    EndFor
    l = newll; Curve Loop(l) = {core_side[]};
    s = news; Plane Surface(s) = {l}; section[] += s;
    inner[] = core[]; inner_arc[] = core_side[];
  EndIf
  For m In {0:#r[] - 1}
    outer[] = {}; arc[] = {};
    For k In {0:3}
      p = newp; Point(p) = {cx + r[m]*Cos((k - 2.5)*Pi/2 + Pi/2), cy + r[m]*Sin((k - 2.5)*Pi/2 + Pi/2), z}; outer[] += p;
    EndFor
    For k In {0:3}
      c = newc; Circle(c) = {outer[k], centre, outer[(k + 1) % 4]}; Transfinite Curve {c} = around + 1; arc[] += c;
    EndFor
    If (m > 0 || has_core)
      n_across = n_r[m];
      Call Across;
    EndIf
    inner[] = outer[]; inner_arc[] = arc[];
  EndFor
  If (to_square)
    outer[] = corner[]; arc[] = side[]; n_across = n_square;
    Call Across;
  EndIf
Return

// Four faces between two closed lines of four corners each.
Macro Across
  ray[] = {};
  For k In {0:3}
    c = newc; Line(c) = {inner[k], outer[k]}; Transfinite Curve {c} = n_across + 1; ray[] += c;
  EndFor
  For k In {0:3}
    l = newll; Curve Loop(l) = {inner_arc[k], ray[(k + 1) % 4], -arc[k], -ray[k]};
    s = news; Plane Surface(s) = {l}; section[] += s;
  EndFor
Return

// Raises section[] by `height` in n_layers -> tops[], bodies[].
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

// The plate with four holes at height z -> section[], kind[] (1 for blocks under the walls, 2 for the one inside).
Macro Plate
  points[] = {}; along_x[] = {}; along_y[] = {}; section[] = {}; kind[] = {};
  For j In {0:ny}
    For i In {0:nx}
      p = newp; Point(p) = {x[i], y[j], z}; points[] += p;
    EndFor
  EndFor
  For j In {0:ny}
    For i In {0:nx - 1}
      c = newc; Line(c) = {points[j*(nx + 1) + i], points[j*(nx + 1) + i + 1]}; Transfinite Curve {c} = n_x[i] + 1; along_x[] += c;
    EndFor
  EndFor
  For j In {0:ny - 1}
    For i In {0:nx}
      c = newc; Line(c) = {points[j*(nx + 1) + i], points[(j + 1)*(nx + 1) + i]}; Transfinite Curve {c} = n_y[j] + 1; along_y[] += c;
    EndFor
  EndFor
  For j In {0:ny - 1}
    For i In {0:nx - 1}
      south = along_x[j*nx + i]; north = along_x[(j + 1)*nx + i];
      west = along_y[j*(nx + 1) + i]; east = along_y[j*(nx + 1) + i + 1];
      If ((i == 1 || i == 5) && (j == 1 || j == 5))
        corner[] = {points[j*(nx + 1) + i], points[j*(nx + 1) + i + 1], points[(j + 1)*(nx + 1) + i + 1], points[(j + 1)*(nx + 1) + i]};
        side[] = {south, east, -north, -west};
        cx = 0.5*(x[i] + x[i + 1]); cy = 0.5*(y[j] + y[j + 1]);
        r[] = {3.3*mm, 5*mm, 6*mm}; n_r[] = {0, 1, 1}; n_square = 1; has_core = 0; to_square = 1;
        Call Rings;
        kind[] += {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
      Else
        l = newll; Curve Loop(l) = {south, east, -north, -west};
        s = news; Plane Surface(s) = {l}; section[] += s;
        is_inside = (i >= 2 && i <= 4 && j >= 2 && j <= 4);
        kind[] += is_inside ? ((i == 3 && j == 3) ? 2 : 1) : 0;
      EndIf
    EndFor
  EndFor
Return

// The box: floor, walls on the ring of blocks around the middle, lid over walls and middle. The lid's middle is a face of its own at
// the walls' height, made of the same lines.
z = 100*mm; Call Plate;
bottom[] = section[]; height = floor_height; n_layers = layers; Call Raise;
floor_bodies[] = bodies[]; floor_tops[] = tops[];
section[] = {};
For i In {0:#kind[] - 1}
  If (kind[i] == 1)
    section[] += floor_tops[i];
  EndIf
EndFor
height = 30*mm; n_layers = 3*around; Call Raise;
wall_bodies[] = bodies[]; wall_tops[] = tops[];
// Inner edges of the walls' tops: those that one of them has alone and that lie on the middle block.
edges[] = Boundary{ Surface{wall_tops[]}; };
inner_edges[] = {};
For i In {0:#edges[] - 1}
  box_of[] = BoundingBox Curve {Fabs(edges[i])};
  If (box_of[0] > -28.1*mm && box_of[3] < 28.1*mm && box_of[1] > -13.1*mm && box_of[4] < 13.1*mm)
    inner_edges[] += edges[i];
  EndIf
EndFor
l = newll; Curve Loop(l) = {inner_edges[]};
middle = news; Plane Surface(middle) = {l};
section[] = {wall_tops[], middle};
height = 3*mm; n_layers = 1; Call Raise;
Physical Volume("box") = {floor_bodies[], wall_bodies[], bodies[]};
Physical Surface("box.lower") = bottom[];
upper[] = {};
For i In {0:#kind[] - 1}
  If (kind[i] != 1)
    upper[] += floor_tops[i];
  EndIf
EndFor
Physical Surface("box.upper") = upper[];
Physical Surface("box.lid") = tops[];

z = 200*mm - bracket_height; Call Plate;
bottom[] = section[]; height = bracket_height; n_layers = 2*layers; Call Raise;
Physical Volume("bracket") = bodies[];
Physical Surface("bracket.lower") = bottom[];
Physical Surface("bracket.upper") = tops[];
sides[] = Abs(Boundary{ Volume{bodies[]}; });
ends[] = {};
For i In {0:#sides[] - 1}
  box_of[] = BoundingBox Surface {sides[i]};
  If (box_of[3] < -54.9*mm || box_of[0] > 54.9*mm)
    ends[] += sides[i];
  EndIf
EndFor
Physical Surface("bracket.ends") = ends[];

cx = 0; cy = 0; to_square = 0;
section[] = {}; z = -bracket_height; r[] = {3*mm}; n_r[] = {1}; has_core = 1; Call Rings;
bottom[] = section[]; height = bracket_height + floor_height + washer_height; n_layers = 4*layers; Call Raise;
Physical Volume("shank") = bodies[];
Physical Surface("shank.lower") = bottom[];
Physical Surface("shank.upper") = tops[];

section[] = {}; z = 300*mm; r[] = {3.3*mm, 5*mm, 6*mm}; n_r[] = {0, 1, 1}; has_core = 0; Call Rings;
bottom[] = section[]; height = washer_height; n_layers = 1; Call Raise;
Physical Volume("washer") = bodies[];
Physical Surface("washer.lower") = bottom[];
Physical Surface("washer.upper") = tops[];

section[] = {}; z = 400*mm; r[] = {3*mm, 3.3*mm, 5*mm}; n_r[] = {1, 1, 1}; has_core = 1; Call Rings;
bottom[] = section[]; height = head_height; n_layers = 2; Call Raise;
Physical Volume("head") = bodies[];
Physical Surface("head.lower") = bottom[];
Physical Surface("head.upper") = tops[];

section[] = {}; z = 500*mm; r[] = {3*mm, 3.3*mm, 5*mm}; n_r[] = {1, 1, 1}; has_core = 1; Call Rings;
bottom[] = section[]; height = nut_height; n_layers = 2; Call Raise;
Physical Volume("nut") = bodies[];
Physical Surface("nut.lower") = bottom[];
Physical Surface("nut.upper") = tops[];
