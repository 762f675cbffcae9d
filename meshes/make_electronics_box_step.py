#!/usr/bin/env python3
"""Writes electronics_box.step: a box of electronics with four feet on a bracket, with a block of boards in it, in millimetres.

    python3 meshes/make_electronics_box_step.py [electronics_box.step]

Bolts are not in it: decks/electronics_box.lua puts standard ones through the holes. Each solid is a product with a name,
as a CAD program would export it; see make_joint_step.py.
"""
import os
import sys

import make_joint_step

make_joint_step.GEOMETRY = """
SetFactory("OpenCASCADE");
Box(1) = {-75, -45, -8, 150, 90, 8};                                 // bracket
Box(2) = {-40, -30, 1, 80, 60, 40};                                  // box, a millimetre above the bracket
Box(5) = {-36, -26, 5, 72, 52, 32};                                  // hollow
Box(3) = {-28, -20, 5, 56, 40, 14};                                  // boards, on the floor of the box
For i In {0:3}
  x = (i == 0 || i == 3) ? -50 : 50;
  y = i < 2 ? -20 : 20;
  side = x < 0 ? -60 : 36;
  Box(10 + i) = {side, y - 10, 0, 24, 20, 6};                        // foot, into the wall of the box
  Cylinder(20 + i) = {x, y, -9, 0, 0, 20, 3.3};                      // clearance hole of M6, medium (ISO 273)
EndFor
BooleanDifference(30) = { Volume{2}; Delete; }{ Volume{5}; Delete; };
BooleanUnion(31) = { Volume{30}; Delete; }{ Volume{10:13}; Delete; };
BooleanDifference(32) = { Volume{1}; Delete; }{ Volume{20:23}; };
BooleanDifference(33) = { Volume{31}; Delete; }{ Volume{20:23}; Delete; };
"""
# Of each solid in the order of its number: product, instance.
make_joint_step.NAMES = [("circuit boards", "boards"), ("bracket 8 mm", "bracket"), ("housing", "box")]
make_joint_step.ASSEMBLY = "electronics_box"

if __name__ == "__main__":
    make_joint_step.main(os.path.join(os.path.dirname(__file__), "electronics_box.step"))
