"""Other scenes that must have the same answer, and what takes the answer back into the axes of the first."""

import copy
import random

import geometry


def turned(scene, matrix):
    """The scene in another orientation."""
    other = copy.deepcopy(scene)
    other["orientation"] = geometry.product(matrix, scene["orientation"])
    return other


def moved(scene, by):
    other = copy.deepcopy(scene)
    other["translation"] = by
    return other


def flipped_face(face, axis):
    return geometry.opposite(face) if geometry.axis_of(face) == axis else face


def mirrored(scene, axis):
    """In the plane through the origin across an axis of the scene."""
    other = copy.deepcopy(scene)

    def flip(v):
        return [-x if i == axis else x for i, x in enumerate(v)]

    for part in other["parts"]:
        part["origin"][axis] = -part["origin"][axis] - part["size"][axis]
        part["velocity"] = flip(part["velocity"])
        part["watched"] = {name: flipped_face(face, axis) for name, face in part["watched"].items()}
    for pattern in other["patterns"]:
        pattern["step"] = flip(pattern["step"])
    sides = [side for joint in other["joints"] for side in (joint["a"], joint["b"])] + [side for support in other["supports"] for side in support["on"]]
    loads = [load for step in other["steps"] for load in step["loads"]]
    sides += [load["on"] for load in loads if isinstance(load["on"], list)]
    for side in {id(side): side for side in sides}.values():
        side[1] = flipped_face(side[1], axis)
    for load in loads:
        if isinstance(load["value"], list):
            load["value"] = flip(load["value"])
        if "axis" in load:
            load["axis"] = geometry.times(-1.0, flip(load["axis"]))    # an axial vector
    other["mirrored"] = axis
    return other


def can_be_mirrored(scene, axis):
    """Prisms and tetrahedra in a box have diagonals, which a mirror would turn; prisms have none along z."""
    return all(part["cell"] in geometry.HEXAHEDRA or (part["cell"].startswith("prism") and axis == 2) for part in scene["parts"])


def swapped(scene):
    other = copy.deepcopy(scene)
    for joint in other["joints"]:
        joint["a"], joint["b"] = joint["b"], joint["a"]
    return other


def scaled(scene, length, stress):
    """Everything that much longer in space and time, and that much stiffer and heavier: an exact similarity, for powers of two without round-off.
    Speeds stay, pressures go with `stress`, forces with stress length^2."""
    other = copy.deepcopy(scene)
    for m in other["materials"]:
        m["young"] *= stress
        m["density"] *= stress
        if m["damping"]:
            m["damping"] = {"mass": m["damping"].get("mass", 0.0) / length, "stiffness": m["damping"]["stiffness"] * length}
    for part in other["parts"]:
        part["origin"], part["size"] = geometry.times(length, part["origin"]), geometry.times(length, part["size"])
    for pattern in other["patterns"]:
        pattern["step"] = geometry.times(length, pattern["step"])
    of_args = {"gap": length, "yield": stress, "hardening": stress / length, "normal": stress, "tangential": stress}
    for joint in other["joints"]:
        joint["args"] = {name: value * of_args[name] if name in of_args else value for name, value in joint["args"].items()}
    of_value = {"pressure": stress, "traction": stress, "force": stress * length**2, "torque": stress * length**3, "gravity": 1 / length, "base_acceleration": 1 / length,
                "velocity": 1.0, "displacement": length, "preload": stress * length**2, "shortening": length, "release": length}
    for step in other["steps"]:
        if step["kind"] == "dynamic":
            step["dt"] *= length
        for load in step["loads"]:
            factor = of_value[load["kind"]]
            load["value"] = geometry.times(factor, load["value"]) if isinstance(load["value"], list) else factor * load["value"]
            if load["history"]:
                load["history"] = {name: value if name in ("shape", "values") else geometry.times(length, value) if isinstance(value, list) else length * value
                                   for name, value in load["history"].items()}
    return other


def chained(scene, k, n_first):
    """Dynamic step number k in two parts, of which the first has n_first time steps; its loads go on."""
    other = copy.deepcopy(scene)
    step = other["steps"][k]
    rest = copy.deepcopy(step)
    t = n_first * step["dt"]
    rest["name"], rest["n"], step["n"] = step["name"] + "_on", step["n"] - n_first, n_first
    for load in rest["loads"]:
        if load["history"]:
            load["history"]["before"] = t
    step["loads"] = [load for load in step["loads"] if load["kind"] != "release" or load["value"] < t]
    rest["loads"] = [load for load in rest["loads"] if load["kind"] != "release" or load["value"] >= t]
    for load in rest["loads"]:
        if load["kind"] == "release":
            load["value"] -= t
    other["steps"].insert(k + 1, rest)
    return other


def nudged(scene, by, seed):
    """Loads, velocities, gaps and shortenings changed by a part of `by` each: what the answer then moves by tells how sharply the scene is determined."""
    other, rng = copy.deepcopy(scene), random.Random(seed)

    def nudge(value):
        return [nudge(v) for v in value] if isinstance(value, list) else value * (1 + by * rng.choice((-1, 1)) * rng.uniform(0.5, 1))

    for part in other["parts"]:
        part["velocity"] = nudge(part["velocity"])
    for joint in other["joints"]:
        joint["args"] = {name: nudge(value) if name == "gap" else value for name, value in joint["args"].items()}
    for step in other["steps"]:
        for load in step["loads"]:
            if load["kind"] != "release":
                load["value"] = nudge(load["value"])
    return other


def refined(scene):
    other = copy.deepcopy(scene)
    for part in other["parts"]:
        part["cells"] = [2 * n for n in part["cells"]]
    return other


def to_scene(scene):
    """The matrix that takes vectors of the results of a scene into axes of the scene before it was turned or mirrored."""
    back = geometry.transposed(scene["orientation"])
    if "mirrored" in scene:
        back[scene["mirrored"]] = [-x for x in back[scene["mirrored"]]]
    return back


def with_points(scene, side_of):
    """Interface points on the side that side_of(scene, joint) names, where it names one."""
    other = copy.deepcopy(scene)
    for joint in other["joints"]:
        side = side_of(scene, joint)
        if side:
            joint["points"] = side
    return other


def freed(scene):
    """The first dynamic step of the scene in free flight: no supports, nothing driven, linear cells, whose masses are equal shares of them."""
    other = copy.deepcopy(scene)
    other["supports"], other["patterns"] = [], []
    step = next(step for step in other["steps"] if step["kind"] == "dynamic")
    step["loads"] = [load for load in step["loads"] if load["kind"] not in ("velocity", "displacement", "base_acceleration")]
    other["steps"] = [step]
    for part in other["parts"]:
        part["cell"] = part["cell"] if part["cell"] in geometry.LINEAR else "hex8"
    for joint in other["joints"]:
        if joint["args"].get("gap", 0) < 0:
            del joint["args"]["gap"]
    return other


def with_finer_steps(scene, by):
    """Time steps that much smaller."""
    other = copy.deepcopy(scene)
    for step in other["steps"]:
        if step["kind"] == "dynamic":
            step["dt"], step["n"] = step["dt"] / by, step["n"] * by
    return other
