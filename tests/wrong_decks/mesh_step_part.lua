local joint = mesh.step{ file = "../../meshes/joint.step", order = 1, size = 10*mm }
local bolt = joint:part "M8 bolt"
