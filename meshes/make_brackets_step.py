#!/usr/bin/env python3
"""Writes brackets.step: a bracket without any symmetry, the same turned and moved, one turned about z, its mirror image,
and one whose hole is 1 % larger, in millimetres.

    python3 meshes/make_brackets_step.py [brackets.step]
"""
import os

import make_joint_step

make_joint_step.GEOMETRY = """
SetFactory("OpenCASCADE");
Macro Bracket
  Box(100 + n) = {0, 0, 0, 40, 20, 4};
  Box(200 + n) = {0, 0, 4, 4, 16, 24};
  Cylinder(300 + n) = {28, 12, -1, 0, 0, 6, radius};
  BooleanUnion(400 + n) = { Volume{100 + n}; Delete; }{ Volume{200 + n}; Delete; };
  BooleanDifference(n) = { Volume{400 + n}; Delete; }{ Volume{300 + n}; Delete; };
Return
radius = 4;
n = 1;
Call Bracket;
Rotate { {1, 2, 2}, {0, 0, 0}, 40*Pi/180 } { Duplicata { Volume{1}; } }   // 2
Translate {10, 60, -15} { Volume{2}; }
Rotate { {0, 0, 1}, {0, 0, 0}, Pi/2 } { Duplicata { Volume{1}; } }        // 3
Translate {-30, 0, 0} { Volume{3}; }
Symmetry {1, 0, 0, 100} { Duplicata { Volume{1}; } }                      // 4
n = 5;
radius = 4.04;
Call Bracket;
Translate {0, -80, 0} { Volume{5}; }
"""
make_joint_step.NAMES = [("bracket", "first"), ("bracket", "turned"), ("bracket", "quarter"), ("left", "mirrored"), ("wide", "wider")]
make_joint_step.ASSEMBLY = "brackets"

if __name__ == "__main__":
    make_joint_step.main(os.path.join(os.path.dirname(__file__), "brackets.step"))
