local cad = mesh.step{ file = "../../meshes/joint.step", unit = 25.4*mm }
