// A mesh that is more than a mesh.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
SystemCall "touch pwned";
