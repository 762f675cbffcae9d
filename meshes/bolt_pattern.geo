// A cover on a base with a gasket between, held by six bolts: three bodies of hexahedra that meet at coincident nodes.
//
//      +----+---------+----+---------+----+---------+----+ - -  y = half_width
//      |    |  head   |    |  head   |    |  head   |    |
//      +----+- +---+ -+----+- +---+ -+----+- +---+ -+----+
//      |    |  | 4 |  |    |  | 5 |  |    |  | 6 |  |    |       holes as wide as the shanks (square, 9 mm); cells of half a
//      +----+- +---+ -+----+- +---+ -+----+- +---+ -+----+       shank under and around the heads (square, 18 mm), coarse
//      |    |         |    |         |    |         |    |       elsewhere
//      +----+- +---+ -+----+- +---+ -+----+- +---+ -+----+
//      |    |  | 1 |  |    |  | 2 |  |    |  | 3 |  |    |
//      +----+- +---+ -+----+- +---+ -+----+- +---+ -+----+
//      |    |         |    |         |    |         |    |
//      +----+---------+----+---------+----+---------+----+
//
//      base     one block, below z = 0
//      gasket   with holes, drawn 100 mm above its place
//      cover    with holes, drawn 200 mm above its place
//
// Drawn apart, since gmsh's own kernel sews together what touches (OpenCASCADE, which does not, takes forty times as long):
// the deck brings them together with `place`.
//
// Volumes    base gasket cover
// Surfaces   base.bottom base.top gasket.lower gasket.upper cover.lower cover.upper
//
// The shanks and heads are boxes of the deck, six times the same, shifted.

DefineConstant[ gasket = {0.003, Min 0.0005, Max 0.02, Name "Parameters/Gasket thickness [m]"},
                plate = {0.015, Min 0.002, Max 0.05, Name "Parameters/Cover thickness [m]"},
                fine = {1, Min 1, Max 8, Name "Parameters/Cells for one in each direction"} ];

mm = 0.001;

// Lines of blocks along x and y, and the cells between each and the next: 4.5 mm at the bolts, coarse elsewhere.
x[] = {-70*mm, -54*mm, -49.5*mm, -40.5*mm, -36*mm, -9*mm, -4.5*mm, 4.5*mm, 9*mm, 36*mm, 40.5*mm, 49.5*mm, 54*mm, 70*mm};
n_x[] = {2, 1, 2, 1, 3, 1, 2, 1, 3, 1, 2, 1, 2};
y[] = {-50*mm, -36*mm, -31.5*mm, -22.5*mm, -18*mm, 18*mm, 22.5*mm, 31.5*mm, 36*mm, 50*mm};
n_y[] = {2, 1, 2, 1, 4, 1, 2, 1, 2};
nx = #n_x[];
ny = #n_y[];

// One face a block at height z, without those over a hole where has_holes is 1, raised by `height` in n_layers
// -> section[] (at z), tops[], bodies[].
Macro Body
  points[] = {}; along_x[] = {}; along_y[] = {};
  For j In {0:ny}
    For i In {0:nx}
      p = newp;
      Point(p) = {x[i], y[j], z};
      points[] += p;
    EndFor
  EndFor
  For j In {0:ny}
    For i In {0:nx - 1}
      c = newc;
      Line(c) = {points[j*(nx + 1) + i], points[j*(nx + 1) + i + 1]};
      Transfinite Curve {c} = fine*n_x[i] + 1;
      along_x[] += c;
    EndFor
  EndFor
  For j In {0:ny - 1}
    For i In {0:nx}
      c = newc;
      Line(c) = {points[j*(nx + 1) + i], points[(j + 1)*(nx + 1) + i]};
      Transfinite Curve {c} = fine*n_y[j] + 1;
      along_y[] += c;
    EndFor
  EndFor
  section[] = {};
  For j In {0:ny - 1}
    For i In {0:nx - 1}
      in_hole = (i == 2 || i == 6 || i == 10) && (j == 2 || j == 6);
      If (!(has_holes && in_hole))
        l = newll;
        Curve Loop(l) = {along_x[j*nx + i], along_y[j*(nx + 1) + i + 1], -along_x[(j + 1)*nx + i], -along_y[j*(nx + 1) + i]};
        s = news;
        Plane Surface(s) = {l};
        section[] += s;
      EndIf
    EndFor
  EndFor
  Transfinite Surface {section[]};
  Recombine Surface {section[]};
  raised[] = Extrude {0, 0, height} { Surface{section[]}; Layers{fine*n_layers}; Recombine; };
  tops[] = {};
  bodies[] = {};
  For i In {0:#section[] - 1}
    tops[] += raised[6*i];
    bodies[] += raised[6*i + 1];
  EndFor
Return

z = -20*mm; height = 20*mm; n_layers = 2; has_holes = 0;
Call Body;
Physical Volume("base") = bodies[];
Physical Surface("base.bottom") = section[];
Physical Surface("base.top") = tops[];

z = 100*mm; height = gasket; n_layers = 1; has_holes = 1;
Call Body;
Physical Volume("gasket") = bodies[];
Physical Surface("gasket.lower") = section[];
Physical Surface("gasket.upper") = tops[];

z = 200*mm + gasket; height = plate; n_layers = 2; has_holes = 1;
Call Body;
Physical Volume("cover") = bodies[];
Physical Surface("cover.lower") = section[];
Physical Surface("cover.upper") = tops[];
