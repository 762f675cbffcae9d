// On either side of a post of half width h on a plate, its outline with a chamfer c at the foot: a coat of thickness t
// (t > 0), or a block.
DefineConstant[ h = 1.5, c = 0.5, s = 10, t = 0, ny = 1 ];
For i In {0:1}
  x = 1 - 2*i; n = 100*i;
  Point(n+1) = {x*(h+c), -10, 0, s}; Point(n+2) = {x*(h+20), -10, 0, s};
  Point(n+7) = {x*h, -10, 20, s}; Point(n+8) = {x*h, -10, c, s};
  Line(n+1) = {n+1,n+2}; Line(n+7) = {n+7,n+8}; Line(n+8) = {n+8,n+1};
  If (t > 0)
    Point(n+3) = {x*(h+20), -10, t, s}; Point(n+4) = {x*(h+c+0.414*t), -10, t, s};
    Point(n+5) = {x*(h+t), -10, c+0.414*t, s}; Point(n+6) = {x*(h+t), -10, 20, s};
    Line(n+2) = {n+2,n+3}; Line(n+3) = {n+3,n+4}; Line(n+4) = {n+4,n+5}; Line(n+5) = {n+5,n+6}; Line(n+6) = {n+6,n+7};
    Curve Loop(n+1) = {n+1,n+2,n+3,n+4,n+5,n+6,n+7,n+8};
  Else
    Point(n+3) = {x*(h+20), -10, 20, s};
    Line(n+2) = {n+2,n+3}; Line(n+3) = {n+3,n+7};
    Curve Loop(n+1) = {n+1,n+2,n+3,n+7,n+8};
  EndIf
  Plane Surface(n+1) = {n+1};
  If (t > 0)
    v[] = Extrude{0,20,0}{ Surface{n+1}; Layers{ny}; Recombine; };
  Else
    v[] = Extrude{0,20,0}{ Surface{n+1}; };
  EndIf
  If (i == 0)
    Physical Volume("right") = {v[1]};
  Else
    Physical Volume("left") = {v[1]};
  EndIf
EndFor
