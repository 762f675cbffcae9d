#!/usr/bin/env python3
"""Writes instrument_unit.step: an electronic unit on a pedestal on a panel, as the CAD of a launcher would have it, in millimetres.

    python3 meshes/make_instrument_unit_step.py [instrument_unit.step]

28 solids, drawn in the unit's own axes (x radial, y tangential, z axial) and then put in their place: 500 mm from the axis of
the launcher, at an azimuth of 30 degrees. Bolts are not in it: decks/instrument_unit.lua puts standard ones through the holes.
Each solid is a product with a name; see make_joint_step.py.
"""
import os
import sys

import make_joint_step

make_joint_step.GEOMETRY = """
SetFactory("OpenCASCADE");
Box(101) = {-100, -70, -10, 200, 140, 10};                           // panel
Box(102) = {-75, -60, 0, 150, 120, 6};                               // pedestal: foot, webs, table
Box(103) = {-72, -45, 40, 144, 90, 6};
Box(104) = {-50, 30, 6, 100, 6, 34};
Box(105) = {-50, -36, 6, 100, 6, 34};
Box(110) = {-55, -40, 46, 110, 80, 50};                              // housing
Box(111) = {-51, -36, 50, 102, 72, 46};                              // hollow
Box(112) = {-55, -40, 96, 110, 80, 3};                               // lid
For i In {0:3}
  sx = (i == 0 || i == 3) ? -1 : 1;
  sy = i < 2 ? -1 : 1;
  Cylinder(120 + i) = {62*sx, 48*sy, -11, 0, 0, 12, 7};              // hole of an insert in the panel
  Cylinder(130 + i) = {62*sx, 48*sy, -11, 0, 0, 20, 3.3};            // clearance hole of M6, medium (ISO 273)
  Cylinder(140 + i) = {62*sx, 28*sy, 39, 0, 0, 20, 2.75};            // of M5
  Box(150 + i) = {62*sx - 7, 28*sy - 12, 46, 14, 24, 6};             // lug of the housing
  Box(160 + i) = {47*sx - 4, 32*sy - 4, 50, 8, 8, 46};               // boss for a screw of the lid
  Cylinder(170 + i) = {47*sx, 32*sy, 86, 0, 0, 20, 2};               // its thread
  Cylinder(180 + i) = {47*sx, 32*sy, 95, 0, 0, 6, 2.4};              // clearance hole in the lid
  Cylinder(190 + i) = {47*sx, 32*sy, 86, 0, 0, 13, 2};               // screw: shank, head
  Cylinder(200 + i) = {47*sx, 32*sy, 99, 0, 0, 3, 3.5};
  Cylinder(210 + i) = {62*sx, 48*sy, -10, 0, 0, 10, 7};              // insert
EndFor
For i In {0:1}
  Cylinder(220 + i) = {0, 104*i - 52, -11, 0, 0, 20, 5};             // hole of a dowel
EndFor

BooleanDifference(1) = { Volume{101}; Delete; }{ Volume{120:123, 220:221}; };          // panel
BooleanUnion(106) = { Volume{102}; Delete; }{ Volume{103:105}; Delete; };
BooleanDifference(2) = { Volume{106}; Delete; }{ Volume{130:133, 140:143, 220:221}; }; // pedestal
For i In {0:3}
  BooleanDifference(3 + i) = { Volume{210 + i}; Delete; }{ Volume{130 + i}; };         // inserts
EndFor
For i In {0:1}
  Cylinder(7 + i) = {0, 104*i - 52, -10, 0, 0, 16, 5};                                 // dowels
EndFor
BooleanDifference(113) = { Volume{110}; Delete; }{ Volume{111}; Delete; };
BooleanUnion(114) = { Volume{113}; Delete; }{ Volume{150:153, 160:163}; Delete; };
BooleanDifference(9) = { Volume{114}; Delete; }{ Volume{140:143, 170:173}; };          // housing
BooleanDifference(10) = { Volume{112}; Delete; }{ Volume{180:183}; Delete; };          // lid
For i In {0:3}
  BooleanUnion(11 + i) = { Volume{190 + i}; Delete; }{ Volume{200 + i}; Delete; };     // screws
EndFor
For i In {0:3}
  sx = (i == 0 || i == 3) ? -1 : 1;
  sy = i < 2 ? -1 : 1;
  Cylinder(15 + i) = {36*sx, 22*sy, 50, 0, 0, 8, 3};                                   // standoffs, low and high
  Cylinder(19 + i) = {36*sx, 22*sy, 60, 0, 0, 18, 3};
EndFor
Box(23) = {-42, -27, 58, 84, 54, 2};                                                   // power board
Box(24) = {-42, -27, 78, 84, 54, 2};                                                   // logic board
Box(25) = {-15, -12, 60, 30, 24, 2};                                                   // pad under the transformer
Box(26) = {-15, -12, 62, 30, 24, 14};                                                  // transformer
Box(27) = {-20, -15, 80, 40, 30, 8};                                                   // heat sink
Box(28) = {-20, -52, 60, 40, 12, 20};                                                  // connector
Recursive Delete { Volume{120:123, 130:133, 140:143, 170:173, 220:221}; }
Translate {500, 0, 0} { Volume{1:28}; }
Rotate {{0, 0, 1}, {0, 0, 0}, Pi/6} { Volume{1:28}; }
"""
# Of each solid in the order of its number: product, instance.
make_joint_step.NAMES = (
    [("PANEL", "panel"), ("PEDESTAL", "pedestal")] + [("INSERT M6", f"insert {i}") for i in range(1, 5)] + [("DOWEL 10X16", f"dowel {i}") for i in (1, 2)]
    + [("HOUSING", "housing"), ("LID", "lid")] + [("SCREW M4X12", f"screw {i}") for i in range(1, 5)] + [("STANDOFF 8", f"standoff low {i}") for i in range(1, 5)]
    + [("STANDOFF 18", f"standoff high {i}") for i in range(1, 5)]
    + [("BOARD", "board power"), ("BOARD", "board logic"), ("PAD", "pad"), ("TRANSFORMER", "transformer"), ("HEAT SINK", "heat sink"), ("CONNECTOR", "connector")])
make_joint_step.ASSEMBLY = "instrument_unit"

if __name__ == "__main__":
    make_joint_step.main(os.path.join(os.path.dirname(__file__), "instrument_unit.step"))
