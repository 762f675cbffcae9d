// A quarter of two rings that fit into one another (the outer one stands 10 mm higher), meshed apart: hexahedra with n_inner and n_outer facets a quarter where they meet.
//
//   volumes inner outer; surface groups inner.bore inner.outside outer.inside outer.rim, and of each: planes (both cuts), faces (both ends)

DefineConstant[ n_inner = {6, Min 2, Max 200, Name "Parameters/Facets of the inner ring"},
                n_outer = {10, Min 2, Max 200, Name "Parameters/Facets of the outer ring"},
                n_radial = {4, Min 1, Max 100, Name "Parameters/Cells across a ring"} ];

mm = 0.001;
thickness = 5*mm;

Macro Ring  // of radii r1 < r2, with n facets a quarter, named by `volume`
  c = newp; Point(c) = {0, 0, z};
  p1 = newp; Point(p1) = {r1, 0, z};
  p2 = newp; Point(p2) = {r2, 0, z};
  p3 = newp; Point(p3) = {0, r2, z};
  p4 = newp; Point(p4) = {0, r1, z};
  l1 = newl; Line(l1) = {p1, p2};
  l2 = newl; Circle(l2) = {p2, c, p3};
  l3 = newl; Line(l3) = {p3, p4};
  l4 = newl; Circle(l4) = {p4, c, p1};
  ll = newll; Curve Loop(ll) = {l1, l2, l3, l4};
  ss = news; Plane Surface(ss) = {ll};
  Transfinite Curve{l1, l3} = n_radial + 1;
  Transfinite Curve{l2, l4} = n + 1;
  Transfinite Surface{ss} = {p1, p2, p3, p4};
  Recombine Surface{ss};
  out[] = Extrude {0, 0, thickness} { Surface{ss}; Layers{1}; Recombine; };  // top, volume, then the sides along the loop
Return

r1 = 20*mm; r2 = 30*mm; z = 0; n = n_inner;
Call Ring;
Physical Volume("inner") = {out[1]};
Physical Surface("inner.outside") = {out[3]};
Physical Surface("inner.bore") = {out[5]};
Physical Surface("inner.planes") = {out[2], out[4]};
Physical Surface("inner.faces") = {ss, out[0]};

r1 = 30*mm; r2 = 40*mm; z = 10*mm; n = n_outer;  // beside the other, for gmsh makes one of equal surfaces
Call Ring;
Physical Volume("outer") = {out[1]};
Physical Surface("outer.rim") = {out[3]};
Physical Surface("outer.inside") = {out[5]};
Physical Surface("outer.planes") = {out[2], out[4]};
Physical Surface("outer.faces") = {ss, out[0]};
