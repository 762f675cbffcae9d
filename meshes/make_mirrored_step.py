#!/usr/bin/env python3
"""Writes mirrored.step: a plate with the mirror image of an angle on it, whose flat faces are splines in the file, in millimetres.

    python3 meshes/make_mirrored_step.py [mirrored.step]
"""
import os

import make_joint_step

make_joint_step.GEOMETRY = """
SetFactory("OpenCASCADE");
Box(1) = {-60, -30, -10, 120, 60, 10};
Box(2) = {10, -10, 0, 30, 20, 5};
Box(3) = {10, -10, 5, 5, 16, 20};
BooleanUnion(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
Symmetry {1, 0, 0, 0} { Volume{4}; }
"""
make_joint_step.NAMES = [("plate", "plate"), ("angle", "mirrored")]
make_joint_step.ASSEMBLY = "mirrored"

if __name__ == "__main__":
    make_joint_step.main(os.path.join(os.path.dirname(__file__), "mirrored.step"))
