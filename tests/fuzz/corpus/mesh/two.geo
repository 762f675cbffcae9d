SetFactory("OpenCASCADE");
Box(1)={0,0,0,1,1,1}; Box(2)={0,0,1,1,1,1};
Coherence;
Mesh.MeshSizeMin=1; Mesh.MeshSizeMax=1;
Physical Volume("low")={1}; Physical Volume("high")={2};
Physical Surface("top",3)={11};
