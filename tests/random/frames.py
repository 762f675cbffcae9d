"""Moment of momentum, from the velocities that frames have: of a scene without supports it is that of the start and of the loads."""

import base64
import struct
import xml.etree.ElementTree
import zlib

import geometry
import histories

MOMENT = 1e-5    # of the largest product of momentum and distance; velocities in frames have seven digits
TYPES = {"Float64": ("d", 8), "Float32": ("f", 4), "Int64": ("q", 8), "Int32": ("i", 4), "UInt8": ("B", 1)}


def numbers(array):
    text = array.text.strip()
    n_blocks = int.from_bytes(base64.b64decode(text[:8])[:4], "little")
    if n_blocks == 0:
        return []
    width = 4 * -(-4 * (3 + n_blocks) // 3)
    sizes = struct.unpack(f"<{3 + n_blocks}I", base64.b64decode(text[:width])[:4 * (3 + n_blocks)])[3:]
    data, at, whole = base64.b64decode(text[width:]), 0, b""
    for size in sizes:
        whole += zlib.decompress(data[at:at + size])
        at += size
    letter, size = TYPES[array.get("type")]
    flat = struct.unpack(f"<{len(whole) // size}{letter}", whole)
    n = int(array.get("NumberOfComponents", 1))
    return list(flat) if n == 1 else [list(flat[i:i + n]) for i in range(0, len(flat), n)]


def arrays(file):
    piece = xml.etree.ElementTree.parse(file).getroot().find("UnstructuredGrid/Piece")
    named = {array.get("Name"): array for array in piece.findall("PointData/DataArray") + piece.findall("Cells/DataArray")}
    return numbers(piece.find("Points/DataArray")), named


def masses(scene, i, points, named):
    """Equal shares of the cells, which in a box are all of one volume for each type."""
    part = scene["parts"][i]
    connectivity, offsets = numbers(named["connectivity"]), numbers(named["offsets"])
    starts = [0] + offsets[:-1]
    material = scene["materials"][part["material"]]
    of_cell = material["density"] * part["size"][0] * part["size"][1] * part["size"][2] / len(offsets)
    found = [0.0] * len(points)
    for start, end in zip(starts, offsets):
        for node in connectivity[start:end]:
            found[node] += of_cell / (end - start)
    return found


def moments_of_loads(scene, step, t0, t1, places):
    """Mean moment over a time step about the origin, in the axes of the scene's results."""
    total, turn = [0.0, 0.0, 0.0], scene["orientation"]
    for load in step["loads"]:
        kind, value, share = load["kind"], load["value"], None
        if kind == "release":
            continue
        share = histories.mean(load["history"], t0, t1)
        if kind == "gravity":
            for i, (m, x) in enumerate(places):
                total = geometry.add(total, geometry.cross(x, geometry.times(share * m, geometry.apply(turn, value))))
            continue
        part, face = load["on"]
        box = scene["parts"][part]
        if kind == "torque":
            total = geometry.add(total, geometry.times(share * value / geometry.norm(load["axis"]), geometry.apply(turn, load["axis"])))
            continue
        area = geometry.area_of_face(box, face)
        force = geometry.times(-value * area, geometry.normal_of(face)) if kind == "pressure" else geometry.times(area if kind == "traction" else 1.0, value)
        total = geometry.add(total, geometry.times(share, geometry.apply(turn, geometry.cross(geometry.centre_of_face(box, face), force))))
    return total


def moment_of_momentum(scene, run):
    """By time step: the change of the moment of momentum against the moment of the loads and of mass damping."""
    step, n_parts = scene["steps"][0], len(scene["parts"])
    history, places, of_points = [], [], []
    for frame in range(step["n"] + 1):
        sums = []
        for i, part in enumerate(scene["parts"]):
            points, named = arrays(run.out / "frames" / f"{part['name']}_{frame:05d}.vtu")
            if frame == 0:
                m = masses(scene, i, points, named)
                of_points.append((m, points))
                places.append((sum(m), geometry.times(1 / sum(m), [sum(mass * x[k] for mass, x in zip(m, points)) for k in range(3)])))
            m, points = of_points[i]
            total = [0.0, 0.0, 0.0]
            for mass, x, v in zip(m, points, numbers(named["velocity"])):
                total = geometry.add(total, geometry.times(mass, geometry.cross(x, v)))
            sums.append(total)
        history.append(sums)
    size = max(max(part["size"]) for part in scene["parts"])
    scale = max([size * geometry.norm(p) for part in scene["parts"] for p in run.tables[f"p_{part['name']}"].vectors()]
                + [geometry.norm(moment) for sums in history for moment in sums]
                + [step["dt"] * geometry.norm(moments_of_loads(scene, step, 0, step["n"] * step["dt"], places)), 1e-300])
    worst = 0.0
    expected = [sum(sums[k] for sums in history[0]) for k in range(3)]
    alphas = [(scene["materials"][part["material"]]["damping"] or {}).get("mass", 0.0) for part in scene["parts"]]
    for n in range(step["n"]):
        loads = moments_of_loads(scene, step, n * step["dt"], (n + 1) * step["dt"], places)
        expected = geometry.add(expected, geometry.times(step["dt"], loads))
        for i in range(n_parts):
            expected = geometry.add(expected, geometry.times(-alphas[i] * step["dt"] / 2, geometry.add(history[n][i], history[n + 1][i])))
        total = [sum(sums[k] for sums in history[n + 1]) for k in range(3)]
        worst = max(worst, geometry.norm(geometry.add(total, geometry.times(-1.0, expected))) / scale)
    return [("moment of momentum of the whole", worst, MOMENT)]
