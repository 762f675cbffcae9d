"""What is done to a scene: steps and their loads. A load is {kind, on, value (a number or a vector), history (None: a plain number)}."""

import math

import geometry


def short(x):
    return float(f"{x:.5g}")


def some_direction(rng):
    """Along an axis of the scene, or any."""
    if rng.random() < 0.5:
        direction = [0.0, 0.0, 0.0]
        direction[rng.randrange(3)] = rng.choice((-1.0, 1.0))
        return direction
    v = [rng.gauss(0, 1) for _ in range(3)]
    return [short(x) for x in geometry.times(1 / geometry.norm(v), v)]


def smallest_transit(scene):
    """The shortest time in which a wave crosses a cell, s."""
    least = math.inf
    for part in scene["parts"]:
        m = scene["materials"][part["material"]]
        speed = math.sqrt(m["young"] * (1 - m["poisson"]) / ((1 + m["poisson"]) * (1 - 2 * m["poisson"])) / m["density"])
        nodes = 1 if part["cell"] in geometry.LINEAR else 2
        least = min(least, min(s / n for s, n in zip(part["size"], part["cells"])) / nodes / speed)
    return least


def free_faces(scene, part):
    taken = [tuple(side) for joint in scene["joints"] for side in (joint["a"], joint["b"])]
    taken += [tuple(side) for support in scene["supports"] for side in support["on"]]
    return [face for face in geometry.FACES if (part, face) not in taken]


def joined_faces(scene, part):
    return [side[1] for joint in scene["joints"] for side in (joint["a"], joint["b"]) if side[0] == part]


def holding_loads(scene):
    """A pressure on each part that one contact alone holds, from behind; on a scene that stands on a wall from above."""
    loads = []
    for i in range(len(scene["parts"])):
        own = [joint for joint in scene["joints"] if i in (joint["a"][0], joint["b"][0])]
        if len(own) == 1 and own[0]["law"] == "contact" and (i > 0 or not scene["supports"]):
            face = geometry.opposite(own[0]["a"][1] if own[0]["a"][0] == i else own[0]["b"][1])
            if face in free_faces(scene, i):
                loads.append({"kind": "pressure", "on": [i, face], "value": scene["style"]["pressure"], "history": None})
    if scene["supports"] and scene["supports"][0]["kind"] == "wall" and "zmax" in free_faces(scene, 0):
        loads.append({"kind": "pressure", "on": [0, "zmax"], "value": scene["style"]["pressure"], "history": None})
    return loads


def draw_history(rng, duration):
    length = short(duration * rng.uniform(0.2, 0.7))
    shape = rng.choice(("half_sine", "half_sine", "haversine", "pulse", "ramp", "step", "piecewise"))
    if shape == "pulse":
        return {"shape": shape, "rise": short(0.2 * length), "hold": short(0.5 * length), "fall": short(0.3 * length)}
    if shape == "step":
        return {"shape": shape, "at": rng.choice((0.0, short(0.3 * length)))}
    if shape == "piecewise":
        return {"shape": shape, "times": [0.0, short(0.3 * length), short(0.6 * length), length], "values": [0.0, 1.0, -0.5, 0.0]}
    return {"shape": shape, "duration": length}


def draw_shock(rng, scene, duration):
    pressure, part = scene["style"]["pressure"], rng.randrange(len(scene["parts"]))
    size = max(max(p["size"]) for p in scene["parts"])
    density = max(m["density"] for m in scene["materials"])
    kinds = ["pressure", "pressure", "traction", "force", "torque", "gravity", "gravity"]
    if scene["supports"] and scene["supports"][0]["kind"] == "fixed":
        kinds += ["base_acceleration"] * 2
    faces = free_faces(scene, part)
    if faces and part > 0:
        kinds += ["velocity", "displacement"]
    kind = rng.choice(kinds)
    load = {"kind": kind, "on": None, "history": draw_history(rng, duration)}
    strength = short(rng.uniform(0.3, 3) * pressure * rng.choice((-1, 1)) * (1e-3 if scene["style"]["faint"] else 1))
    if kind in ("gravity", "base_acceleration"):
        load["value"] = [short(strength / (density * size) * x) for x in some_direction(rng)]
        load["on"] = 0 if kind == "base_acceleration" else None
        return load
    if not faces:
        return None
    face = rng.choice(faces)
    if kind in ("velocity", "displacement") and rng.random() < 0.3:
        face = rng.choice(joined_faces(scene, part) or faces)
    load["on"] = [part, face]
    area = geometry.area_of_face(scene["parts"][part], face)
    if kind == "pressure":
        load["value"] = strength
    elif kind == "traction":
        load["value"] = [short(0.5 * strength * x) for x in some_direction(rng)]
    elif kind == "force":
        load["value"] = [short(0.5 * strength * area * x) for x in some_direction(rng)]
    elif kind == "torque":
        load["axis"] = geometry.normal_of(face)
        load["value"] = short(0.1 * strength * area * size)
    else:
        speed = abs(strength) / math.sqrt(density * max(m["young"] for m in scene["materials"]))
        load["value"] = [short(speed * (1 if kind == "velocity" else duration) * x) for x in some_direction(rng)]
        load["history"] = {"shape": rng.choice(("half_sine", "haversine")), "duration": short(0.6 * duration)}
    return load


def tightening(rng, scene):
    """Loads that tighten the bolts of a clamped scene, all alike."""
    bolts = [k for k, joint in enumerate(scene["joints"]) if joint.get("bolt")]
    if not bolts:
        return []
    size = scene["parts"][1]["size"]
    if rng.random() < 0.5 and len(scene["parts"]) > 4:
        force = short(scene["style"]["pressure"] * rng.uniform(0.5, 1.5) * size[0] * size[1])
        return [{"kind": "preload", "on": k, "value": force, "history": None} for k in bolts]
    young = min(m["young"] for m in scene["materials"])
    return [{"kind": "shortening", "on": k, "value": short(scene["style"]["pressure"] / young * size[2] * rng.uniform(1, 4)), "history": None} for k in bolts]


def draw_steps(rng, scene):
    style, steps = scene["style"], scene["steps"]
    hold = holding_loads(scene)
    if style["statics"]:
        loads = list(hold)
        if rng.random() < 0.3:
            size, density = max(max(p["size"]) for p in scene["parts"]), max(m["density"] for m in scene["materials"])
            loads.append({"kind": "gravity", "on": None, "value": [0.0, 0.0, short(-0.3 * style["pressure"] / (density * size))], "history": None})
            hold = loads
        if not loads and style["layout"] == "grown":
            last = len(scene["parts"]) - 1
            faces = free_faces(scene, last)
            if faces:
                loads.append({"kind": "pressure", "on": [last, rng.choice(faces)], "value": style["pressure"], "history": None})
                hold = loads
        steps.append({"name": "press", "kind": "static", "increments": rng.randint(1, 3), "loads": loads + tightening(rng, scene)})
        if rng.random() < 0.25:
            steps.append({"name": "again", "kind": "static", "increments": rng.randint(1, 2),
                          "loads": [{**load, "value": times(0.6, load["value"])} for load in hold]})
            hold = steps[-1]["loads"]
        side = to_the_side(rng, scene, hold) if rng.random() < 0.3 else None
        if side:
            steps.append({"name": "side", "kind": "static", "increments": rng.randint(1, 3), "loads": list(hold) + [side]})
            hold = hold + [side] if side["kind"] == "traction" else hold
    if not style["statics"] or rng.random() < 0.75:
        draw_dynamic_steps(rng, scene, hold)


def to_the_side(rng, scene, hold):
    """A force along a contact that is pressed, below what friction holds, or a displacement that drags over it."""
    pressed = [load for load in hold if load["kind"] == "pressure" and any(
        joint["args"].get("friction") and load["on"][0] in (joint["a"][0], joint["b"][0]) for joint in scene["joints"])]
    if not pressed:
        return None
    part, face = rng.choice(pressed)["on"]
    axis = geometry.axis_of(face)
    direction = [0.0 if i == axis else rng.choice((-1.0, 1.0)) * rng.uniform(0.2, 1) for i in range(3)]
    if rng.random() < 0.5:
        return {"kind": "traction", "on": [part, face], "value": times(scene["style"]["pressure"] * rng.uniform(0.02, 0.1), direction), "history": None}
    young, size = min(m["young"] for m in scene["materials"]), max(scene["parts"][part]["size"])
    into = geometry.times(-0.5, geometry.normal_of(face))
    return {"kind": "displacement", "on": [part, face], "value": times(scene["style"]["pressure"] / young * size * rng.uniform(0.3, 2), geometry.add(direction, into)), "history": None}


def times(factor, value):
    return [short(factor * x) for x in value] if isinstance(value, list) else short(factor * value)


def draw_dynamic_steps(rng, scene, hold):
    style = scene["style"]
    dt, n = float(f"{smallest_transit(scene) * rng.choice((0.5, 1, 1, 2)):.3g}"), rng.randint(16, 48)
    loads = list(hold)
    thrown = style["support"] == "none" or rng.random() < (0.05 if style["statics"] else 0.3)
    if thrown:
        density, young = max(m["density"] for m in scene["materials"]), max(m["young"] for m in scene["materials"])
        speed = style["pressure"] / math.sqrt(density * young)
        velocities = [short(2 * speed * rng.uniform(-1, 1)) for _ in range(3)]
        for i in thrown_together(rng, scene):
            scene["parts"][i]["velocity"] = list(velocities)
    if not thrown or rng.random() < 0.5:
        shock = draw_shock(rng, scene, n * dt)
        if shock and not any(load["on"] == shock["on"] and load["kind"] == shock["kind"] for load in loads):
            loads.append(shock)
    if scene["joints"] and rng.random() < 0.1:
        loads.append({"kind": "release", "on": rng.randrange(len(scene["joints"])), "value": short(n * dt * rng.uniform(0.1, 0.6)), "history": None})
    scene["steps"].append({"name": "shock", "kind": "dynamic", "dt": dt, "n": n, "loads": loads})
    if rng.random() < 0.25:
        scene["steps"].append({"name": "rest", "kind": "dynamic", "dt": float(f"{dt * rng.choice((0.5, 1, 2)):.3g}"), "n": rng.randint(8, 20), "loads": list(hold)})
        if scene["supports"] and rng.random() < 0.2:
            scene["steps"][-1]["let_go"] = True


def thrown_together(rng, scene):
    """A part, and mostly all that are joined to it by more than contact, so that no tie joins unlike velocities."""
    group = {rng.randrange(len(scene["parts"]))}
    while rng.random() < 0.9:
        more = {side[0] for joint in scene["joints"] if joint["law"] != "contact" and group & {joint["a"][0], joint["b"][0]} for side in (joint["a"], joint["b"])}
        if more <= group:
            break
        group |= more
    held = {side[0] for support in scene["supports"] for side in support["on"] if support["kind"] != "wall"}
    return group if not group & held else set()
