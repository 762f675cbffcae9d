"""Draws a scene from a seed: parts, joints, supports; draw_steps adds what is done to them.

A scene is plain data (JSON): parts and joints in axes of its own, and an orientation in which the deck writes all of it.
"""

import json
import math
import random

import geometry
from draw_steps import draw_steps

MM = 1e-3
LATTICE = 2 * MM


def short(x):
    return float(f"{x:.5g}")


def wave_speed(material):
    e, nu, rho = material["young"], material["poisson"], material["density"]
    return math.sqrt(e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / rho)


def draw_material(rng, name):
    young = short(rng.choice((3e9, 45e9, 70e9, 210e9)) * rng.uniform(0.6, 1.5))
    damping = rng.choice((0, 0, 0, {"stiffness": 1e-8}, {"stiffness": 1e-7}, {"mass": 500.0, "stiffness": 1e-8}))
    return {"name": name, "young": young, "poisson": rng.choice((0.0, 0.2, 0.3, 0.45)), "density": rng.choice((1000.0, 2700.0, 7800.0)),
            "damping": damping}


def draw_part(rng, scene, size=None):
    """A box at the origin; in like scenes all cells are the lattice's."""
    style = scene["style"]
    size = size or [rng.choice((2, 3, 3, 4)) * LATTICE for _ in range(3)]
    if style["meshes"] == "like":
        cells, cell = [round(s / LATTICE) for s in size], style["cell"]
    else:
        cells = [max(1, min(4, round(s / LATTICE * rng.choice((0.5, 0.75, 1, 1, 1.5))))) for s in size]
        cell = rng.choice(geometry.LINEAR + ("hex8", "hex8")) if rng.random() < 0.75 else rng.choice(geometry.QUADRATIC)
    if cell in geometry.QUADRATIC:
        cells = [max(1, (n + 1) // 2) for n in cells] if style["meshes"] == "unlike" else cells
    return {"name": f"P{len(scene['parts'])}", "origin": [0.0, 0.0, 0.0], "size": [short(s) for s in size], "cells": cells, "cell": cell,
            "material": rng.randrange(len(scene["materials"])), "velocity": [0.0, 0.0, 0.0], "watched": {"u": "zmax", "v": "xmin"}}


def touches(a, b):
    """The faces in which two boxes meet with an area, None where they do not; True where they lie in each other."""
    lap = [geometry.overlap(a, b, axis) for axis in range(3)]
    if min(lap) > 1e-9:
        return True
    axis = min(range(3), key=lambda i: lap[i])
    if abs(lap[axis]) > 1e-9 or sorted(lap)[1] < 1e-9:
        return None
    upper = geometry.near(geometry.ends(a, axis)[1], geometry.ends(b, axis)[0])
    return "xyz"[axis] + ("max" if upper else "min")


def put_on(rng, scene, part, parent, face):
    """Moves a part onto a face of another, with an offset along the lattice or half of it."""
    axis = geometry.axis_of(face)
    grid = LATTICE if scene["style"]["meshes"] == "like" else LATTICE / 2
    for i in range(3):
        low, high = geometry.ends(parent, i)
        if i == axis:
            part["origin"][i] = short(high if geometry.is_upper(face) else low - part["size"][i])
            continue
        least = low - part["size"][i] / 2
        most = high - part["size"][i] / 2
        part["origin"][i] = short(grid * round(rng.uniform(least, most) / grid) if rng.random() < scene["style"]["offsets"] else low)


def draw_law(rng, scene, may_slide):
    """may_slide: is the part held by others, so that this joint need not carry in static steps?"""
    statics = scene["style"]["statics"]
    pressure, length = scene["style"]["pressure"], 3 * LATTICE
    laws = ["bonded", "contact", "contact", "plastic"] + (["viscous"] if may_slide or not statics else [])
    law = rng.choice(laws)
    if law == "contact":
        args = {"friction": rng.choice((0.0, 0.1, 0.3, 0.6))}
        gap = rng.choice((0, 0, 0, 1, 1, -0.5 if statics else 0))    # an interference is pressed out by a static step
        if gap:
            args["gap"] = short(gap * rng.uniform(0.2, 1) * 1e-6)
        return law, args
    if law == "plastic":
        args = {"yield": short(pressure * rng.uniform(0.3, 3)), "hardening": short(pressure / (rng.uniform(0.002, 0.02) * length))}
        if not statics and rng.random() < 0.4:
            args["hardening"] = 0.0
        if rng.random() < 0.3:
            args["compression"] = True
        return law, args
    if law == "viscous":
        impedance = max(m["density"] * wave_speed(m) for m in scene["materials"])
        return law, {"normal": short(impedance * rng.uniform(0.1, 2)), "tangential": rng.choice((0.0, short(impedance * rng.uniform(0.05, 0.5))))}
    return law, {}


def join(rng, scene, a, face, b, may_slide=False):
    law, args = draw_law(rng, scene, may_slide)
    sides = [[a, face], [b, geometry.opposite(face)]]
    if rng.random() < 0.5:
        sides.reverse()
    scene["joints"].append({"name": f"J{a}{b}", "law": law, "a": sides[0], "b": sides[1], "args": args})


def grow(rng, scene, n):
    """Each part stands on a face of one that is there; where it touches others too, it is joined to them as well."""
    scene["parts"].append(draw_part(rng, scene))
    taken = {(0, "zmin")}
    for _ in range(20 * n):
        if len(scene["parts"]) == n:
            return
        parent, face = rng.randrange(len(scene["parts"])), rng.choice(("zmax", "zmax", "zmax") + geometry.FACES)
        if (parent, face) in taken:
            continue
        part = draw_part(rng, scene)
        put_on(rng, scene, part, scene["parts"][parent], face)
        met = [touches(other, part) for other in scene["parts"]]
        if True in met or (geometry.ends(part, 2)[0] < -1e-9 and scene["style"]["support"] == "wall"):
            continue
        if any(other is not None and (i, other) in taken for i, other in enumerate(met)):
            continue
        scene["parts"].append(part)
        new = len(scene["parts"]) - 1
        order = [parent] + [i for i, other in enumerate(met) if other is not None and i != parent]
        for i in order:
            join(rng, scene, i, met[i], new, may_slide=i != parent)
            taken.add((new, geometry.opposite(met[i])))


def clamp(rng, scene, n):
    """Two plates and posts in a row between them, of which one or more are shortened."""
    lower = draw_part(rng, scene, [6 * LATTICE, 2 * LATTICE, 2 * LATTICE])
    scene["parts"].append(lower)
    post = draw_part(rng, scene, [LATTICE, 2 * LATTICE, rng.choice((1, 2, 3)) * LATTICE])
    post["origin"] = [0.0, 0.0, short(2 * LATTICE)]
    step = [short(rng.choice((2, 2.5) if n == 2 else (2,)) * LATTICE), 0.0, 0.0]
    members = []
    for i in range(n):
        copy = {**post, "name": f"P{1 + i}", "origin": geometry.add(post["origin"], geometry.times(i, step))}
        members.append(len(scene["parts"]))
        scene["parts"].append(copy)
    if rng.random() < 0.7:
        scene["patterns"].append({"members": members, "step": step})
    else:
        for i in members[1:]:
            scene["parts"][i]["material"] = rng.randrange(len(scene["materials"]))
    upper = draw_part(rng, scene, [6 * LATTICE, 2 * LATTICE, 2 * LATTICE])
    upper["origin"] = [0.0, 0.0, short(2 * LATTICE + post["size"][2])]
    scene["parts"].append(upper)
    top = len(scene["parts"]) - 1
    bolts = {0} if n == 2 else rng.choice(({1}, {0, 2}))    # of three posts the middle one or the outer ones, so that plates stay parallel
    for k, i in enumerate(members):
        bolt = k in bolts
        for a, b, name in ((0, i, "B"), (i, top, "T")):
            law, args = ("bonded", {}) if bolt else draw_law(rng, scene, may_slide=False)
            if bolt and name == "T" and rng.random() < 0.6:
                law, args = "plastic", {"yield": short(scene["style"]["pressure"] * rng.uniform(2, 6)), "hardening": short(scene["style"]["pressure"] / MM)}
            scene["joints"].append({"name": f"{name}{i}", "law": law, "a": [a, "zmax"], "b": [b, "zmin"], "args": args, "bolt": bolt and name == "T"})


def stand(rng, scene):
    kind = scene["style"]["support"]
    if kind == "fixed":
        scene["supports"].append({"name": "base", "kind": "fixed", "on": [[0, "zmin"]], "args": {}})
    elif kind == "symmetry":
        scene["supports"].append({"name": "base", "kind": "symmetry", "on": [[0, "zmin"], [0, "xmin"], [0, "ymin"]], "args": {}})
    elif kind == "absorbing":
        scene["supports"].append({"name": "base", "kind": "absorbing", "on": [[0, "zmin"]], "args": {}})
    elif kind == "wall":
        scene["supports"].append({"name": "base", "kind": "wall", "on": [[0, "zmin"]], "args": {"friction": rng.choice((0.0, 0.2, 0.5))}})


def draw(seed):
    rng = random.Random(f"scene {seed}")
    style = {"meshes": rng.choice(("like", "like", "unlike")), "cell": rng.choice(("hex8", "hex8", "hex8", "prism6", "tet4", "hex20", "hex27", "tet10", "prism15")),
             "offsets": rng.choice((0.0, 0.5, 1.0)), "statics": rng.random() < 0.5, "layout": rng.choice(("grown", "grown", "grown", "clamped"))}
    style["support"] = rng.choice(("fixed", "fixed", "fixed", "symmetry", "absorbing", "wall") + (() if style["statics"] else ("none", "none")))
    if style["layout"] == "clamped":
        style["support"] = "fixed"
    style["manner"] = rng.choice(("implicit", "implicit", "implicit", "explicit", "automatic"))
    style["faint"] = style["statics"] and rng.random() < 0.15
    scene = {"seed": seed, "style": style, "materials": [draw_material(rng, f"m{i}") for i in range(rng.randint(1, 3))],
             "parts": [], "joints": [], "supports": [], "patterns": [], "steps": [], "orientation": None}
    style["pressure"] = short(min(m["young"] for m in scene["materials"]) * 10 ** rng.uniform(-4.5, -3.3))
    if style["layout"] == "clamped":
        clamp(rng, scene, rng.randint(2, 3))
    else:
        grow(rng, scene, rng.choice((2, 2, 3, 3, 4, 5, 6, 8)))
    stand(rng, scene)
    draw_steps(rng, scene)
    scene["patterns"] = [pattern for pattern in scene["patterns"] if len({tuple(scene["parts"][i]["velocity"]) for i in pattern["members"]}) == 1]
    how = rng.random()
    scene = json.loads(json.dumps(scene))    # no two steps share a load
    scene["orientation"] = geometry.IDENTITY if how < 0.4 else geometry.quarter_turn(rng) if how < 0.6 else geometry.oblique_turn(rng)
    return scene
