#!/usr/bin/env python3
"""Writes joint.step: two plates that lie on each other, two M8 bolts through clearance holes, in millimetres.

    python3 meshes/make_joint_step.py [joint.step]

What a CAD program would export: each solid a product with a name, placed once in an assembly. gmsh builds and writes the
solids (its library is loaded as it is, no module of Python's is needed); the names are put in afterwards, since gmsh
writes none.
"""
import ctypes
import ctypes.util
import os
import re
import sys
import tempfile

GEOMETRY = """
SetFactory("OpenCASCADE");
Box(1) = {-40, -20, 0, 80, 40, 10};                                  // lower plate
Box(2) = {-40, -20, 10, 80, 40, 8};                                  // upper plate
For i In {0:1}
  x = -20 + 40*i;
  Cylinder(10 + i) = {x, 0, -1, 0, 0, 20, 4.5};                      // clearance hole
  Cylinder(20 + i) = {x, 0, -8, 0, 0, 26, 4};                        // shank
  Cylinder(30 + i) = {x, 0, 18, 0, 0, 5.3, 6.5};                     // head
  Cylinder(40 + i) = {x, 0, -6.8, 0, 0, 6.8, 6.5};                   // nut, one with the shank
EndFor
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{10, 11}; };
BooleanDifference(4) = { Volume{2}; Delete; }{ Volume{10, 11}; Delete; };
BooleanUnion(5) = { Volume{20}; Delete; }{ Volume{30, 40}; Delete; };
BooleanUnion(6) = { Volume{21}; Delete; }{ Volume{31, 41}; Delete; };
"""
# Of each solid in the order of its number: product, instance.
NAMES = [("plate 10 mm", "lower"), ("plate 8 mm", "upper"), ("M8 bolt", "bolt1"), ("M8 bolt", "bolt2")]
ASSEMBLY = "joint"


def write_solids(geo, step):
    library = ctypes.CDLL(ctypes.util.find_library("gmsh") or "libgmsh.so")
    error = ctypes.c_int(0)
    library.gmshInitialize(0, None, 0, ctypes.byref(error))
    library.gmshOptionSetNumber(b"General.Terminal", ctypes.c_double(0), ctypes.byref(error))
    library.gmshOpen(geo.encode(), ctypes.byref(error))
    library.gmshWrite(step.encode(), ctypes.byref(error))
    library.gmshFinalize(ctypes.byref(error))
    if error.value:
        sys.exit("gmsh could not build or write the solids")


def put_names(text):
    text = re.sub(r"FILE_NAME\('[^']*','[^']*'", "FILE_NAME('%s.step','2024-01-01T00:00:00'" % ASSEMBLY, text)
    for number, (product, instance) in enumerate(NAMES, 1):
        own = r"'Open CASCADE STEP translator [0-9.]+ \d+\.%d'" % number
        text, n = re.subn(r"(PRODUCT\(\s*)%s(\s*,\s*)%s" % (own, own), r"\1'%s'\2'%s'" % (product, product), text)
        if n != 1:
            sys.exit("product %d is not where it was expected" % number)
        text, n = re.subn(r"(NEXT_ASSEMBLY_USAGE_OCCURRENCE\(\s*)'%d'(\s*,\s*)'[^']*'" % number,
                          r"\1'%d'\2'%s'" % (number, instance), text)
        if n != 1:
            sys.exit("instance %d is not where it was expected" % number)
    return re.sub(r"'Open CASCADE STEP translator [0-9.]+ \d+'", "'%s'" % ASSEMBLY, text)


def main(default):
    target = sys.argv[1] if len(sys.argv) > 1 else default
    with tempfile.TemporaryDirectory() as folder:
        geo, step = os.path.join(folder, "joint.geo"), os.path.join(folder, "joint.step")
        with open(geo, "w") as file:
            file.write(GEOMETRY)
        write_solids(geo, step)
        with open(step) as file:
            text = file.read()
    with open(target, "w") as file:
        file.write(put_names(text))


if __name__ == "__main__":
    main(os.path.join(os.path.dirname(__file__), "joint.step"))
