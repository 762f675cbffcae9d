Point(1)={0,0,0,1};
l[]=Extrude{1,0,0}{Point{1};Layers{1};Recombine;};
s[]=Extrude{0,1,0}{Line{l[1]};Layers{1};Recombine;};
v[]=Extrude{0,0,1}{Surface{s[1]};Layers{1};Recombine;};
Physical Volume("low")={v[1]}; Physical Surface("low.top",2)={v[0]};
