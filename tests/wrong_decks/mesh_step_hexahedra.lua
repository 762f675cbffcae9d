local joint = mesh.step{ file = "../../meshes/joint.step", order = 1, size = 10*mm, cells = "hexahedra" }
