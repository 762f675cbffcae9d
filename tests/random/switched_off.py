"""What scenes have, and what is not drawn or not compared at present, each with its reason: the one place to switch it on again.

A row is (trait, relation or "*" for all, reason). `random_scenes.py --with TRAIT` ignores the rows of a trait.
"""

import itertools

import compare
import geometry

SWITCHED_OFF = [
    ("friction alone may hold a part", "*", "no answer is the right one: a part that an interference presses out, with nothing behind it, stops where the force on it falls to nothing (scene 16, 4e-5 of the motion; its way aside is 34, 8.5 and 2.1 nm in 3, 12 and 48 increments, and the run says that 72, 39 and 14 % of the energy are numerical dissipation); one that stands on a line of points rocks (269, 4e-3; 86 %); one between two contacts without force has play (5042, 0.26 nm of 790, all of it)"),
    ("unlike meshes", "points", "cells as large as the overlap: which face has the points changes as much as cells of half the size do"),
    ("on the verge of tipping", "*", "no answer is the right one; for good"),
    ("driven beside what holds the other side", "*", "no answer is the right one: along an edge of the bond one side is held and the other driven, and how far a mesh tears there is its own (894: 28 % of the energy given back on release; 401: 65 kN in a mesh of few cells); where all of a point's nodes are held the deck is refused; for good"),
    ("friction in a ring", "*", "three parts joined in a ring: laws that meet there share their force in a way that is not unique, and with it what slides and what yields; for good"),
]


def meets(parts, part, face, joint):
    """Have a face of a part and a joint on that part nodes in common?"""
    if part not in (joint["a"][0], joint["b"][0]):
        return False
    low, high = geometry.in_common(parts, joint)
    own_low = [geometry.ends(parts[part], i)[0] for i in range(3)]
    own_high = [geometry.ends(parts[part], i)[1] for i in range(3)]
    own_low[geometry.axis_of(face)] = own_high[geometry.axis_of(face)] = geometry.place_of_face(parts[part], face)
    return all(min(high[k], own_high[k]) - max(low[k], own_low[k]) > -1e-9 for k in range(3))


def traits(scene):
    parts, joints = scene["parts"], scene["joints"]
    loads = [load for step in scene["steps"] for load in step["loads"]]
    statics = [step for step in scene["steps"] if step["kind"] == "static"]
    found = {f"law {joint['law']}" for joint in joints} | {f"load {load['kind']}" for load in loads} | {f"cell {part['cell']}" for part in parts}
    found |= {f"support {support['kind']}" for support in scene["supports"]}
    matching = all(geometry.nodes_coincide(parts, joint) for joint in joints)
    conditions = {
        "unlike meshes": not matching,
        "overhang": any(not geometry.nodes_coincide(parts, joint) and not inner(parts, joint) for joint in joints),
        "order two": any(part["cell"] in geometry.QUADRATIC for part in parts),
        "oblique": any(min(abs(abs(x) - k) for k in (0, 1)) > 1e-9 for row in scene["orientation"] for x in row),
        "friction": any(joint["args"].get("friction") for joint in joints + scene["supports"]),
        "interference": any(joint["args"].get("gap", 0) < 0 for joint in joints),
        "gap in a static step": bool(statics) and any(joint["args"].get("gap", 0) > 0 for joint in joints),
        "static": bool(statics),
        "faint motion about a preload": scene["style"].get("faint", False),
        "dragged over friction": any(load["kind"] == "displacement" for step in statics for load in step["loads"]),
        "motion about a preload": bool(statics) and len(statics) < len(scene["steps"]),
        "on the verge of tipping": bool(statics) and any(verges(scene, load) for load in loads),
        "left free in a static step": bool(statics) and len(held_parts(scene)) < len(scene["parts"]),
        "friction alone may hold a part": bool(statics) and may_be_held_by_friction_alone(scene),
        "tie between unlike velocities": any(parts[joint["a"][0]]["velocity"] != parts[joint["b"][0]]["velocity"] for joint in joints if joint["law"] != "contact"),
        "driven at a joint": any(meets(parts, *load["on"], joint) for load in loads if load["kind"] in ("velocity", "displacement") for joint in joints),
        "driven beside what holds the other side": any(is_torn(scene, joint, load) for load in loads if load["kind"] in ("velocity", "displacement") for joint in joints),
        "held at a joint with friction": any(meets(parts, part, face, joint) for support in scene["supports"] for part, face in support["on"]
                                             for joint in joints if joint["args"].get("friction")),
        "friction in a ring": any(is_ring(parts, ring) and any(joint["args"].get("friction") for joint in ring) and sum(joint["law"] in ("contact", "plastic") for joint in ring) > 1
                                  for ring in itertools.combinations(joints, 3)),
        "joints that meet": len(joints) > 1 and bool(compare.sharing_joints(scene)),
    }
    return found | {name for name, has in conditions.items() if has}


def is_torn(scene, joint, load):
    """Does a load drive the face of a tied part where a support holds the other one?"""
    parts, (driven, face) = scene["parts"], load["on"]
    others = [side[0] for side in (joint["a"], joint["b"]) if side[0] != driven]
    return joint["law"] != "contact" and len(others) == 1 and meets(parts, driven, face, joint) and any(
        part == others[0] and meets(parts, part, on, joint) for support in scene["supports"] for part, on in support["on"])


def inner(parts, joint):
    (a, face), (b, _) = joint["a"], joint["b"]
    return geometry.lies_within(parts[a], parts[b], face) or geometry.lies_within(parts[b], parts[a], face)


def is_ring(parts, joints):
    """Do three joints join three parts with each other, and meet?"""
    places = [geometry.in_common(parts, joint) for joint in joints]
    low, high = ([pick(place[end][i] for place in places) for i in range(3)] for end, pick in ((0, max), (1, min)))
    return len({side[0] for joint in joints for side in (joint["a"], joint["b"])}) == 3 and len({frozenset((joint["a"][0], joint["b"][0])) for joint in joints}) == 3 \
        and all(high[i] - low[i] > -1e-9 for i in range(3))


def runs_inside(low, high, centre, axis):
    """Does a line along an axis run inside a rectangle, a fifth of its size from its rim at least?"""
    return all(low[i] + 0.2 * (high[i] - low[i]) < centre[i] < high[i] - 0.2 * (high[i] - low[i]) for i in range(3) if i != axis)


def tied_with(scene, part):
    """The part and those tied to it."""
    together = {part}
    pairs = [{joint["a"][0], joint["b"][0]} for joint in scene["joints"] if joint["law"] != "contact"]
    while any(len(pair & together) == 1 for pair in pairs):
        together |= set().union(*(pair for pair in pairs if pair & together))
    return together


def verges_on_wall(scene, part, face):
    """Does the line of a pressure pass by, or run along the rim of, a wall that alone stands behind the part and those tied to it?"""
    together = tied_with(scene, part)
    if len(scene["supports"]) != 1 or scene["supports"][0]["kind"] != "wall":
        return False
    centre = geometry.centre_of_face(scene["parts"][part], face)
    for on, behind in scene["supports"][0]["on"]:
        if on in together and behind == geometry.opposite(face):
            low, high = ([geometry.ends(scene["parts"][on], i)[end] for i in range(3)] for end in (0, 1))
            if not runs_inside(low, high, centre, geometry.axis_of(face)):
                return True
    return False


def verges(scene, load):
    """Does a pressure hold its part, and those tied to it, on a contact, or on one behind that, by a force whose line passes the contact's rectangle by, or runs along its rim?"""
    if load["kind"] != "pressure":
        return False
    part, face = load["on"]
    if verges_on_wall(scene, part, face):
        return True
    centre, reached, behind = geometry.centre_of_face(scene["parts"][part], face), set(), tied_with(scene, part)
    while behind - reached:
        reached |= behind
        for joint in scene["joints"]:
            sides = {joint["a"][0]: joint["a"][1], joint["b"][0]: joint["b"][1]}
            ours = [on for on in sides if on in reached]
            if joint["law"] == "contact" and len(ours) == 1 and sides[ours[0]] == geometry.opposite(face):
                if not runs_inside(*geometry.in_common(scene["parts"], joint), centre, geometry.axis_of(face)):
                    return True
                behind = behind | set().union(*(tied_with(scene, on) for on in sides))
    return False


def is_pressed(scene, joint):
    """Does a pressure from behind one of its parts close a contact in all static steps?"""
    behind = [[side[0], geometry.opposite(side[1])] for side in (joint["a"], joint["b"])]
    return all(any(load["kind"] == "pressure" and load["on"] in behind and load["value"] > 0 for load in step["loads"]) for step in scene["steps"] if step["kind"] == "static")


def held_parts(scene):
    """Those that more holds, alone or together, than contact that is smooth or not pressed, dampers and smooth walls."""
    held = {side[0] for support in scene["supports"] for side in support["on"] if support["kind"] != "wall" or support["args"]["friction"]}
    holding = [{joint["a"][0], joint["b"][0]} for joint in scene["joints"] if joint["law"] in ("bonded", "plastic")
               or joint["law"] == "contact" and joint["args"]["friction"] and is_pressed(scene, joint)]
    while any(len(pair & held) == 1 for pair in holding):
        held |= set().union(*(pair for pair in holding if pair & held))
    return held


def may_be_held_by_friction_alone(scene):
    """Have parts that nothing else holds a contact with a gap, or an interference, and one with friction?"""
    held = held_parts(scene)
    contacts = [joint["args"] for joint in scene["joints"] if joint["law"] == "contact" and not {joint["a"][0], joint["b"][0]} <= held]
    return any(args.get("gap") for args in contacts) and any(args["friction"] for args in contacts)


def why_off(scene_traits, relation, switched_on=()):
    """The reason not to try a relation ("*": any) on a scene with these traits; empty where it is tried."""
    for trait, of, reason in SWITCHED_OFF:
        if trait in scene_traits and trait not in switched_on and of in (relation, "*"):
            return f"{trait}: {reason}"
    return ""
