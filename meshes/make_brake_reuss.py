#!/usr/bin/env python3
"""Mesh of the Brake-Reuss beam, 720 x 25.4 x 25.4 mm: two halves that lap over 120 mm, three bolts of 5/16 in, in hexahedra.

    python3 meshes/make_brake_reuss.py                                              # meshes/brake_reuss.msh, cells of order two
    python3 meshes/make_brake_reuss.py --n 4 --nz 3 --nx 12 --out meshes/brake_reuss_fine.msh

x along the beam from the middle of the joint, y across, z along the bolts, the lap at z = 0. Each half has its washers, heads or nuts
and half of the shanks. Volumes top (x = -360 to 60 mm, z > 0 in the lap) and bot; faces PART.lap, PART.tip, PART.mid1 to mid3 (the shanks'
section in the lap's plane). The mesh is flat: the deck gives the form of the faces.
"""
import argparse
import math
import numpy

parser = argparse.ArgumentParser()
parser.add_argument("--out", default="meshes/brake_reuss.msh")
parser.add_argument("--n", type=int, default=2, help="cells over the width; 4 n around each hole")
parser.add_argument("--nz", type=int, default=2, help="cells over the thickness of the lap")
parser.add_argument("--nx", type=int, default=10, help="cells along each arm")
parser.add_argument("--order", type=int, default=2, choices=(1, 2))
given = parser.parse_args()

mm = 1e-3
LENGTH, LAP, HEIGHT, HALF_WIDTH = 360 * mm, 60 * mm, 12.7 * mm, 12.7 * mm
HOLES = (-30 * mm, 0.0, 30 * mm)
WASHER, HEAD, STUB = 1.5875 * mm, 5.159 * mm, 4.366 * mm
# A head is a cylinder of the hexagon's area. Chords of linear cells lie outside the circle, for its area.
GROW = 1.0 if given.order == 2 else math.sqrt(math.pi / (2 * given.n * math.sin(math.pi / (2 * given.n))))
R_SHANK, R_HOLE, R_HEAD, R_WASHER = (r * mm * GROW for r in (3.96875, 4.25, 6.668, 8.73125))


class Volume:
    def __init__(self, name):
        self.name, self.known, self.nodes, self.cells = name, {}, [], []

    def node(self, place):
        key = tuple(round(c * 1e7) for c in place)
        near = [(key[0] + i, key[1] + j, key[2] + k) for i in (0, -1, 1) for j in (0, -1, 1) for k in (0, -1, 1)]
        for other in near:
            if other in self.known:
                return self.known[other]
        self.known[key] = len(self.nodes)
        self.nodes.append(place)
        return self.known[key]

    def block(self, place, us, vs, ws):
        """Cells between the values of u, v and w; place(u, v, w) in m."""
        order = given.order

        def fine(values):
            if order == 1:
                return list(values)
            all_values = [values[0]]
            for low, high in zip(values, values[1:]):
                all_values += [(low + high) / 2, high]
            return all_values

        number = {}
        for i, u in enumerate(fine(us)):
            for j, v in enumerate(fine(vs)):
                for k, w in enumerate(fine(ws)):
                    if order == 1 or (i % 2) + (j % 2) + (k % 2) <= 1:
                        number[i, j, k] = self.node(place(u, v, w))
        for i in range(len(us) - 1):
            for j in range(len(vs) - 1):
                for k in range(len(ws) - 1):
                    corners = [(order * (i + x), order * (j + y), order * (k + z)) for x, y, z in CORNERS]
                    x = numpy.array([self.nodes[number[c]] for c in corners])
                    if numpy.dot(numpy.cross(x[1] - x[0], x[3] - x[0]), x[4] - x[0]) < 0:
                        corners = [corners[c] for c in (3, 2, 1, 0, 7, 6, 5, 4)]
                    cell = [number[c] for c in corners]
                    if order == 2:
                        cell += [number[tuple((a + b) // 2 for a, b in zip(corners[p], corners[q]))] for p, q in EDGES]
                    self.cells.append(cell)


CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
EDGES = ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7))  # gmsh's order
FACETS = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def steps(n):
    return [i / n for i in range(n + 1)]


def circle(x, radius, sector):
    return lambda u: (x + radius * math.cos(math.pi / 2 * (sector + u - 0.5)), radius * math.sin(math.pi / 2 * (sector + u - 0.5)))


def rectangle(x, half_x, half_y, sector):
    corners = ((half_x, -half_y), (half_x, half_y), (-half_x, half_y), (-half_x, -half_y))
    p, q = corners[sector], corners[(sector + 1) % 4]
    return lambda u: (x + p[0] + (q[0] - p[0]) * u, p[1] + (q[1] - p[1]) * u)


def between(inner, outer):
    return lambda u, v: tuple(a * (1 - v) + b * v for a, b in zip(inner(u), outer(u)))


def extrude(volume, plan, us, vs, low, high, n):
    volume.block(lambda u, v, w: (*plan(u, v), low + (high - low) * w), us, vs, steps(n))


def half(name, up):
    volume, n, nz = Volume(name), given.n, given.nz
    bearing, top = HEIGHT + WASHER, HEIGHT + WASHER + HEAD
    ends = max(1, round(0.7 * n))
    for x_0, x_1 in ((-LAP, -45 * mm), (45 * mm, LAP)):
        extrude(volume, lambda u, v: (x_0 + (x_1 - x_0) * u, HALF_WIDTH * (2 * v - 1)), steps(ends), steps(n), 0, up * HEIGHT, nz)
    for x in HOLES:
        core = 0.47 * R_SHANK
        shank = [(0, bearing, max(2, nz)), (bearing, top, 1)] + ([(top, top + STUB, 1)] if up < 0 else [])
        for low, high, m in shank:
            extrude(volume, lambda u, v: (x + core * (2 * u - 1), core * (2 * v - 1)), steps(n), steps(n), up * low, up * high, m)
        for s in range(4):
            rings = (circle(x, R_SHANK, s), circle(x, R_HOLE, s), circle(x, R_HEAD, s), circle(x, R_WASHER, s), rectangle(x, 15 * mm, HALF_WIDTH, s))
            for low, high, m in shank:
                extrude(volume, between(rectangle(x, core, core, s), rings[0]), steps(n), [0, 1], up * low, up * high, m)
            for inner, outer in zip(rings[1:], rings[2:]):
                extrude(volume, between(inner, outer), steps(n), [0, 1], 0, up * HEIGHT, nz)
            for inner, outer in zip(rings[1:3], rings[2:4]):
                extrude(volume, between(inner, outer), steps(n), [0, 1], up * HEIGHT, up * bearing, 1)
            for inner, outer in zip(rings[:2], rings[1:3]):
                extrude(volume, between(inner, outer), steps(n), [0, 1], up * bearing, up * top, 1)
    # Cells of an arm grow by 3 from the joint on.
    sizes = [3 ** (i / max(1, given.nx - 1)) for i in range(given.nx)]
    along = [sum(sizes[:i]) / sum(sizes) for i in range(given.nx + 1)]
    volume.block(lambda u, v, w: (-up * (LAP + (LENGTH - LAP) * u), HALF_WIDTH * (2 * v - 1), HEIGHT * (2 * w - 1)), along, steps(n), steps(2 * nz))
    return volume


def face_of(volume, places, up):
    x, y, z = places.T
    if numpy.all(abs(x + up * LENGTH) < 1e-8):
        return "tip"
    if numpy.any(abs(z) > 1e-8) or numpy.any(abs(x) > LAP + 1e-8):
        return None
    from_bolts = [numpy.max(numpy.hypot(x - hole, y)) for hole in HOLES]
    for i, far in enumerate(from_bolts):
        if far < R_SHANK + 1e-7:
            return f"mid{i + 1}"
    return "lap"


volumes, first, faces = [half("top", 1), half("bot", -1)], 0, {}
nodes, cells = [], []
for volume, up in zip(volumes, (1, -1)):
    places, count = numpy.array(volume.nodes), {}
    for cell in volume.cells:
        for facet in FACETS:
            count.setdefault(tuple(sorted(cell[i] for i in facet)), []).append((cell, facet))
    for found in count.values():
        if len(found) > 1:
            continue
        cell, facet = found[0]
        on_face = [cell[i] for i in facet]
        if given.order == 2:
            middle = {frozenset(edge): 8 + e for e, edge in enumerate(EDGES)}
            on_face += [cell[middle[frozenset((facet[i], facet[(i + 1) % 4]))]] for i in range(4)]
        name = face_of(volume, places[on_face[:4]], up)
        if name:
            faces.setdefault(f"{volume.name}.{name}", []).append([node + first for node in on_face])
    cells.append([[node + first for node in cell] for cell in volume.cells])
    nodes += volume.nodes
    first += len(volume.nodes)

hexahedron, quadrangle = ((5, 3), (17, 16))[given.order - 1]
with open(given.out, "w") as out:
    out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{len(volumes) + len(faces)}\n")
    for i, name in enumerate(faces):
        out.write(f'2 {i + 1} "{name}"\n')
    for i, volume in enumerate(volumes):
        out.write(f'3 {i + 1} "{volume.name}"\n')
    out.write(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
    for i, place in enumerate(nodes):
        out.write("%d %.9g %.9g %.9g\n" % (i + 1, *place))
    out.write(f"$EndNodes\n$Elements\n{sum(map(len, cells)) + sum(map(len, faces.values()))}\n")
    element = 0
    for kind, groups in ((quadrangle, faces.values()), (hexahedron, cells)):
        for i, group in enumerate(groups):
            for of_group in group:
                element += 1
                out.write(f"{element} {kind} 2 {i + 1} {i + 1} {' '.join(str(node + 1) for node in of_group)}\n")
    out.write("$EndElements\n")
print(f"{given.out}: {sum(map(len, cells))} cells, {3 * len(nodes)} unknowns; " + ", ".join(f"{name} {len(group)}" for name, group in faces.items()))
