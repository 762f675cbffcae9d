// One bolt's sector of two flanged rings of a launcher stage, one part at a time; hexahedra, the sector's middle on the x axis, the joint at z = 0.
//
//      r = 498 502
//           | |   shell                 body = 1: volume upper; surfaces upper.mating upper.seat upper.left upper.right (the cuts) upper.end
//           | |                                   upper.band (of the inner face, where the charge lies)
//           |=| band                    body = 2: volume lower, its mirror image: lower.mating ... lower.band
//           | |                         body = 3: volume stud, shank and nut: stud.head_end (top of the shank), stud.seat
//    +--+ +-+ |   flange                body = 4: volume head: head.stud_end, head.seat
//    +--+ +---+                         (mm; 24 bolts M10 on r = 475, flanges from r = 455 on)
//      bolt
//
// Cells of about `size`; along the cuts and the shell the same numbers for both parts of a body, so that sectors turned by 15 degrees match.

SetFactory("OpenCASCADE");
DefineConstant[ body = {1, Choices{1="upper", 2="lower", 3="stud", 4="head"}, Name "Parameters/Body"},
                size = {0.006, Min 0.0005, Max 0.02, Name "Parameters/Cell size [m]"},
                bolts = {24, Min 8, Max 200, Name "Parameters/Number of bolts"} ];
mm = 0.001;
r_in = 455*mm; r_bolt = 475*mm; r_1 = 498*mm; r_2 = 502*mm;
thick = 10*mm;                                     // of a flange
to_band = 60*mm; band = 20*mm; beyond = 100*mm;    // heights of the shell
shank = 5*mm; hole = 5.5*mm; rim = 9*mm; cap = 6*mm;
a = Pi/bolts;
n_quarter = Max(2, Round(12*mm/size));
n_radial = Max(2, Round((r_1 - r_in)/size));
n_arc = Max(4, Round(2*a*r_1/size));
n_thick = Max(1, Round(thick/size));
n_seat = Max(1, Round((rim - hole)/size));

// Four points around the bolt at 45 degrees and more, distance rho, height z -> corners[]; edges[] from each to the next.
Macro Loop4
  corners[] = {}; edges[] = {};
  For i In {0:3}
    p = newp;
    Point(p) = {r_bolt + rho*Cos(Pi/4 + i*Pi/2), rho*Sin(Pi/4 + i*Pi/2), z};
    corners[] += p;
  EndFor
  For i In {0:3}
    l = newl;
    If (straight)
      Line(l) = {corners[i], corners[(i + 1)%4]};
    Else
      Circle(l) = {corners[i], centre, corners[(i + 1)%4]};
    EndIf
    Transfinite Curve{l} = n_quarter + 1;
    edges[] += l;
  EndFor
Return
// Four faces from the loop inner_corners[] inner_edges[] out to rho, n_across cells -> ring[].
Macro Ring4
  Call Loop4;
  spokes[] = {}; ring[] = {};
  For i In {0:3}
    l = newl;
    Line(l) = {inner_corners[i], corners[i]};
    Transfinite Curve{l} = n_across + 1;
    spokes[] += l;
  EndFor
  For i In {0:3}
    ll = newll;
    Curve Loop(ll) = {inner_edges[i], spokes[(i + 1)%4], -edges[i], -spokes[i]};
    s = news;
    Plane Surface(s) = {ll};
    Transfinite Surface{s};
    ring[] += s;
  EndFor
  inner_corners[] = corners[]; inner_edges[] = edges[];
Return

If (body <= 2)
  side = 3 - 2*body;                               // 1: up, -1: down
  z = 0;
  centre = newp; Point(centre) = {r_bolt, 0, z};
  rho = hole; straight = 0; Call Loop4;
  inner_corners[] = corners[]; inner_edges[] = edges[];
  rho = rim; n_across = n_seat; Call Ring4;
  seat[] = ring[]; around[] = edges[];

  axis = newp; Point(axis) = {0, 0, 0};
  radii[] = {r_in, r_1, r_2};
  left[] = {}; right[] = {}; arcs[] = {};
  For i In {0:2}
    p = newp; Point(p) = {radii[i]*Cos(a), -radii[i]*Sin(a), 0}; left[] += p;
    p = newp; Point(p) = {radii[i]*Cos(a), radii[i]*Sin(a), 0}; right[] += p;
    l = newl; Circle(l) = {left[i], axis, right[i]}; arcs[] += l;
    Transfinite Curve{l} = n_arc + 1;
  EndFor
  cuts[] = {};
  For i In {0:1}
    l = newl; Line(l) = {left[i], left[i + 1]}; cuts[] += l;
    l = newl; Line(l) = {right[i], right[i + 1]}; cuts[] += l;
  EndFor
  Transfinite Curve{cuts[0], cuts[1]} = n_radial + 1;
  Transfinite Curve{cuts[2], cuts[3]} = 2;
  outer = newll; Curve Loop(outer) = {cuts[0], arcs[1], -cuts[1], -arcs[0]};
  inner = newll; Curve Loop(inner) = around[];
  plate = news; Plane Surface(plate) = {outer, inner};
  ll = newll; Curve Loop(ll) = {cuts[2], arcs[2], -cuts[3], -arcs[1]};
  strip = news; Plane Surface(strip) = {ll};
  Transfinite Surface{strip};
  Recombine Surface{seat[], plate, strip};

  // Of each face: top, volume, then the sides along its loop; of the strip and what stands on it: left, outer, right, inner.
  raised[] = {}; volumes[] = {};
  out[] = Extrude {0, 0, side*thick} { Surface{seat[], plate, strip}; Layers{n_thick}; Recombine; };
  For i In {0:3}
    raised[] += out[6*i]; volumes[] += out[6*i + 1];
  EndFor
  volumes[] += {out[25], out[35]};                 // of the plate: 24 top, 26 to 29 its outline, 30 to 33 the hole
  lefts[] = {out[26], out[36]}; rights[] = {out[28], out[38]};
  out[] = {out[34]};
  heights[] = {to_band, band, beyond};
  For i In {0:2}
    out[] = Extrude {0, 0, side*heights[i]} { Surface{out[0]}; Layers{Max(1, Round(heights[i]/size))}; Recombine; };
    volumes[] += out[1]; lefts[] += out[2]; rights[] += out[4];
    If (i == 1)
      inside = out[5];
    EndIf
  EndFor
  If (body == 1)
    Physical Volume("upper") = volumes[];
    Physical Surface("upper.mating") = {seat[], plate, strip};
    Physical Surface("upper.seat") = raised[];
    Physical Surface("upper.left") = lefts[];
    Physical Surface("upper.right") = rights[];
    Physical Surface("upper.end") = out[0];
    Physical Surface("upper.band") = inside;
  Else
    Physical Volume("lower") = volumes[];
    Physical Surface("lower.mating") = {seat[], plate, strip};
    Physical Surface("lower.seat") = raised[];
    Physical Surface("lower.left") = lefts[];
    Physical Surface("lower.right") = rights[];
    Physical Surface("lower.end") = out[0];
    Physical Surface("lower.band") = inside;
  EndIf
Else
  z = body == 3 ? -thick - cap : thick;
  centre = newp; Point(centre) = {r_bolt, 0, z};
  rho = 0.6*shank; straight = 1; Call Loop4;
  ll = newll; Curve Loop(ll) = edges[];
  core = news; Plane Surface(core) = {ll};
  Transfinite Surface{core};
  inner_corners[] = corners[]; inner_edges[] = edges[];
  rho = shank; straight = 0; n_across = 1; Call Ring4;
  disc[] = {core, ring[]};
  rho = hole; n_across = 1; Call Ring4;
  disc_rim[] = ring[];
  rho = rim; n_across = n_seat; Call Ring4;
  collar[] = ring[];
  section[] = {disc[], disc_rim[], collar[]};
  Recombine Surface{section[]};
  tops[] = {}; volumes[] = {};
  out[] = Extrude {0, 0, cap} { Surface{section[]}; Layers{Max(1, Round(cap/size))}; Recombine; };
  For i In {0:12}
    tops[] += out[6*i]; volumes[] += out[6*i + 1];
  EndFor
  If (body == 3)
    ends[] = {};
    out[] = Extrude {0, 0, 2*thick} { Surface{tops[{0:4}]}; Layers{Max(2, Round(2*thick/size))}; Recombine; };
    For i In {0:4}
      ends[] += out[6*i]; volumes[] += out[6*i + 1];
    EndFor
    Physical Volume("stud") = volumes[];
    Physical Surface("stud.head_end") = ends[];
    Physical Surface("stud.seat") = tops[{9:12}];
  Else
    Physical Volume("head") = volumes[];
    Physical Surface("head.stud_end") = disc[];
    Physical Surface("head.seat") = collar[];
  EndIf
EndIf
