"""Makes a failing scene smaller while it goes on failing: fewer steps, parts, joints, loads, cells, simpler laws and histories."""

import copy
import time

import geometry


def without_part(scene, i):
    other = copy.deepcopy(scene)
    gone = [k for k, joint in enumerate(other["joints"]) if i in (joint["a"][0], joint["b"][0])]
    for k in reversed(gone):
        other = without_joint(other, k)
    del other["parts"][i]
    for support in other["supports"]:
        support["on"] = [side for side in support["on"] if side[0] != i]
    keep = [k for k, support in enumerate(other["supports"]) if support["on"]]
    for step in other["steps"]:
        step["loads"] = [load for load in step["loads"] if not (isinstance(load["on"], list) and load["on"][0] == i)
                         and not (load["kind"] == "base_acceleration" and load["on"] not in keep)]
        for load in step["loads"]:
            if load["kind"] == "base_acceleration":
                load["on"] = keep.index(load["on"])
    other["supports"] = [other["supports"][k] for k in keep]
    sides = [side for joint in other["joints"] for side in (joint["a"], joint["b"])] + [side for support in other["supports"] for side in support["on"]]
    sides += [load["on"] for step in other["steps"] for load in step["loads"] if isinstance(load["on"], list)]
    for side in {id(side): side for side in sides}.values():
        side[0] -= side[0] > i
    other["patterns"] = [{**pattern, "members": [m - (m > i) for m in pattern["members"]]} for pattern in other["patterns"] if i not in pattern["members"]]
    return other


def without_joint(scene, k):
    other = copy.deepcopy(scene)
    del other["joints"][k]
    for step in other["steps"]:
        of_joints = ("preload", "shortening", "release")
        step["loads"] = [load for load in step["loads"] if not (load["kind"] in of_joints and load["on"] == k)]
        for load in step["loads"]:
            if load["kind"] in of_joints:
                load["on"] -= load["on"] > k
    return other


def with_change(scene, change):
    other = copy.deepcopy(scene)
    return other if change(other) is not False else None


def changed(container, key, value):
    """A change that does nothing is none."""
    if container.get(key) == value:
        return False
    container[key] = value
    return True


def smaller(scene):
    """Scenes that are a step smaller, the largest steps first."""
    if len(scene["steps"]) > 1:
        yield {**copy.deepcopy(scene), "steps": copy.deepcopy(scene["steps"][:-1])}
        yield {**copy.deepcopy(scene), "steps": copy.deepcopy(scene["steps"][1:])}
    if len(scene["parts"]) > 1:
        for i in reversed(range(len(scene["parts"]))):
            yield without_part(scene, i)
    for k in reversed(range(len(scene["joints"]))):
        yield without_joint(scene, k)
    for s, step in enumerate(scene["steps"]):
        for k in reversed(range(len(step["loads"]))):
            yield with_change(scene, lambda o: o["steps"][s]["loads"].pop(k))
        for key in ("n", "increments"):
            if step.get(key, 1) > 1:
                yield with_change(scene, lambda o: changed(o["steps"][s], key, step[key] // 2))
    if scene["patterns"]:
        yield with_change(scene, lambda o: changed(o, "patterns", []))
    yield with_change(scene, lambda o: changed(o, "orientation", geometry.IDENTITY))
    yield with_change(scene, lambda o: any([changed(part, "cells", [max(1, n // 2) for n in part["cells"]]) for part in o["parts"]]))
    yield with_change(scene, lambda o: any([changed(part, "cell", "hex8") for part in o["parts"]]))
    yield with_change(scene, lambda o: any([changed(part, "material", 0) for part in o["parts"]]))
    yield with_change(scene, lambda o: any([changed(m, "damping", 0) for m in o["materials"]]))
    yield with_change(scene, lambda o: any([changed(m, "poisson", 0.0) for m in o["materials"]]))
    for i in range(len(scene["parts"])):
        yield with_change(scene, lambda o: changed(o["parts"][i], "cells", [1, 1, 1]))
        yield with_change(scene, lambda o: changed(o["parts"][i], "cells", [max(1, n // 2) for n in o["parts"][i]["cells"]]))
        yield with_change(scene, lambda o: changed(o["parts"][i], "cell", "hex8"))
        yield with_change(scene, lambda o: changed(o["parts"][i], "velocity", [0.0, 0.0, 0.0]))
    for k, joint in enumerate(scene["joints"]):
        for name in list(joint["args"]):
            if name not in ("yield", "normal", "hardening", "friction"):
                yield with_change(scene, lambda o: o["joints"][k]["args"].pop(name))
        if joint["args"].get("friction"):
            yield with_change(scene, lambda o: changed(o["joints"][k]["args"], "friction", 0.0))
        if joint["law"] != "bonded":
            yield with_change(scene, lambda o: o["joints"][k].update(law="bonded", args={}))
    for s, step in enumerate(scene["steps"]):
        for k, load in enumerate(step["loads"]):
            if load["history"] and step["kind"] == "dynamic":
                yield with_change(scene, lambda o: changed(o["steps"][s]["loads"][k], "history", None))
    yield with_change(scene, rounded)


def rounded(scene):
    """Two digits are enough for the numbers of a deck that is read."""
    def two(x):
        return [two(v) for v in x] if isinstance(x, list) else float(f"{x:.2g}")

    before = repr(scene)
    for m in scene["materials"]:
        m["young"] = two(m["young"])
    for part in scene["parts"]:
        part["velocity"] = two(part["velocity"])
    for joint in scene["joints"]:
        joint["args"] = {name: value if isinstance(value, bool) else two(value) for name, value in joint["args"].items()}
    for step in scene["steps"]:
        for load in step["loads"]:
            load["value"] = two(load["value"])
    return repr(scene) != before


def is_sound(scene):
    return bool(scene["parts"] and scene["steps"])


def shrunk(scene, still_fails, seconds, least=0):
    """The smallest scene found within the time that still fails; at least `least` candidates are tried."""
    end, tried, progress = time.monotonic() + seconds, 0, True
    while progress:
        progress = False
        for candidate in smaller(scene):
            if time.monotonic() > end and tried >= least:
                return scene
            if candidate is None or not is_sound(candidate):
                continue
            tried += 1
            if still_fails(candidate):
                scene, progress = candidate, True
                break
    return scene
