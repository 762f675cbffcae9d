"""What must balance within one run: energy, the momentum and the equilibrium of each part, and the signs of what is dissipated.

Each book answers a list of (what, by how much, how much is allowed).
"""

import math

import compare
import geometry
import histories

# Shares of the largest energy, force or impulse of a run that is solved to 1e-9 (1e-10 in static steps): ten thousand times what iteration leaves.
ENERGY, FORCE = 1e-5, 1e-5
# What friction and the scheme may give back: slip that turns round within an increment, with whose mean friction works, and a plastic joint that stops yielding within one,
# which works with the mean of its two openings (L3): with the square of dt (1.9, 0.10 and 0.006 % at dt, dt/4 and dt/16, scene 2611293159), and the run says so.
GAIN, GAIN_OF_PLASTIC = 1e-3, 3e-2


def largest_energy(table):
    stored = [sum(table[name][i] for name in ("kinetic", "strain", "friction", "plastic", "damping", "scheme")) for i in range(len(table))]
    return max([abs(x) for x in stored] + [abs(x) for name in ("kinetic", "strain", "loads") for x in table[name]])


def energy(scene, run, floor, least_motion=1e-6):
    table = run.tables["energy"]
    scale = max(largest_energy(table), floor)
    found = [("energy balance", max(map(abs, table["balance"])) / scale, ENERGY)]
    gain = GAIN_OF_PLASTIC if any(joint["law"] == "plastic" for joint in scene["joints"]) else GAIN
    for step in scene["steps"]:
        rows = table.rows_of(step["name"])
        if not rows:
            continue
        for name in ("friction", "plastic", "damping") + (("scheme",) if step["kind"] == "dynamic" else ()):
            values, fall, most = [table[name][i] for i in rows], 0.0, -float("inf")
            for value in values:
                most = max(most, value)
                fall = max(fall, most - value)
            allowed = {"scheme": gain, "friction": GAIN}.get(name, ENERGY)
            found.append((f"{name} gives energy in step '{step['name']}'", fall / scale, allowed))
        if step["kind"] == "dynamic":
            # The step by itself, however much a preload has stored.
            own = max(max(table["kinetic"][i] for i in rows), least_motion * scale)
            missing = max(abs(table["balance"][i] - table["balance"][rows[0]]) for i in rows)
            found.append((f"energy balance against the motion of step '{step['name']}'", missing / own, 1e-3))
    return found


def load_on(scene, load, share):
    """The force of a load on its part in the axes of the scene: (part, vector), or one for each part in gravity."""
    parts = scene["parts"]
    kind, value = load["kind"], load["value"]
    if kind == "gravity":
        return [(i, geometry.times(share * part_mass(scene, i), value)) for i in range(len(parts))]
    if kind not in ("pressure", "traction", "force"):
        return []
    i, face = load["on"]
    area = geometry.area_of_face(parts[i], face)
    vector = geometry.times(-value * area, geometry.normal_of(face)) if kind == "pressure" else geometry.times(area if kind == "traction" else 1.0, value)
    return [(i, geometry.times(share, vector))]


def part_mass(scene, i):
    part = scene["parts"][i]
    return scene["materials"][part["material"]]["density"] * part["size"][0] * part["size"][1] * part["size"][2]


def same(load, other):
    return load["kind"] == other["kind"] and load["on"] == other["on"] and load["history"] is None and other["history"] is None


def shares_in_static(scene, k, increment):
    """(load, share): a plain number is ramped from what the same load had before; one left out is ramped off."""
    step = scene["steps"][k]
    before = scene["steps"][k - 1]["loads"] if k > 0 else []
    t = increment / step["increments"]
    for load in step["loads"]:
        yield load, t
        for old in before:
            if same(load, old):
                yield old, 1 - t
    for old in before:
        if not any(same(load, old) for load in step["loads"]):
            yield old, 1 - t


def driven_parts(step):
    """Parts whose forces are not all told in a step: prescribed motions have no resultant."""
    return {load["on"][0] for load in step["loads"] if load["kind"] in ("velocity", "displacement")}


def forces(scene, run, step, row, count):
    """The sum of joints and supports on each part in a row of a step that has `count` of them."""
    sums = [[0.0, 0.0, 0.0] for _ in scene["parts"]]
    back = geometry.transposed(scene["orientation"])
    for joint in scene["joints"] + scene["supports"]:
        table = run.tables[f"r_{joint['name']}"]
        rows = table.rows_of(step)
        i = rows[row - count]    # from the end, since statics have a row of the start in some tables
        force = geometry.apply(back, [table[x][i] for x in "xyz"])
        if "a" in joint:
            sums[joint["a"][0]] = geometry.add(sums[joint["a"][0]], force)
            sums[joint["b"][0]] = geometry.add(sums[joint["b"][0]], geometry.times(-1.0, force))
        else:
            sums[joint["on"][0][0]] = geometry.add(sums[joint["on"][0][0]], force)
    return sums


def scale_of_forces(scene, run):
    most = scene["style"]["pressure"] * 1e-6 * max(max(part["size"]) for part in scene["parts"]) ** 2
    for joint in scene["joints"] + scene["supports"]:
        most = max([most, *map(geometry.norm, run.tables[f"r_{joint['name']}"].vectors())])
    return most


def equilibrium(scene, run):
    """Static steps: forces on each part at the end of each increment."""
    worst, scale = (0.0, ""), scale_of_forces(scene, run)
    for k, step in enumerate(scene["steps"]):
        if step["kind"] != "static":
            break    # after a dynamic step loads begin from what that had
        for n in range(1, step["increments"] + 1):
            sums = forces(scene, run, step["name"], n - 1, step["increments"])
            for load, share in shares_in_static(scene, k, n):
                for i, vector in load_on(scene, load, share):
                    sums[i] = geometry.add(sums[i], vector)
                    scale = max(scale, geometry.norm(vector))
            for i, left in enumerate(sums):
                if i not in driven_parts(step):
                    worst = max(worst, (geometry.norm(left) / scale, f"equilibrium of {scene['parts'][i]['name']} in step '{step['name']}', increment {n}"))
    return [(worst[1] or "equilibrium", worst[0], FORCE)]


def momentum(scene, run):
    """Dynamic steps: what a part gains in momentum is the impulse of its joints, supports, loads and mass damping."""
    worst, scale = (0.0, ""), scale_of_forces(scene, run)
    back = geometry.transposed(scene["orientation"])
    tables = [run.tables[f"p_{part['name']}"] for part in scene["parts"]]
    for step in scene["steps"]:
        if step["kind"] != "dynamic":
            continue
        rows = [table.rows_of(step["name"]) for table in tables]
        # Tables have nine digits: what a thousandth of the momentum of free flight would take to stop is the least that is compared with.
        scale = max([scale] + [1e-3 / step["dt"] * geometry.norm(p) for table in tables for p in table.vectors()])
        for n in range(step["n"]):
            sums = forces(scene, run, step["name"], n, step["n"])
            for load in step["loads"]:
                for i, vector in load_on(scene, load, histories.mean(load["history"], n * step["dt"], (n + 1) * step["dt"])):
                    sums[i] = geometry.add(sums[i], vector)
                    scale = max(scale, geometry.norm(vector))
            for i, part in enumerate(scene["parts"]):
                if i in driven_parts(step):
                    continue
                p0, p1 = (geometry.apply(back, [tables[i][x][rows[i][n + m]] for x in "xyz"]) for m in (0, 1))
                damping = scene["materials"][part["material"]]["damping"]
                alpha = damping.get("mass", 0.0) if damping else 0.0
                gain = geometry.add(geometry.times(1 / step["dt"] + alpha / 2, p1), geometry.times(-1 / step["dt"] + alpha / 2, p0))
                # An explicit part takes a time step in several increments: what damping took is then not the mean of both ends.
                unsure = alpha * geometry.norm(geometry.add(p1, geometry.times(-1.0, p0)))
                left = max(0.0, geometry.norm(geometry.add(sums[i], geometry.times(-1.0, gain))) - unsure)
                worst = max(worst, (left / scale, f"momentum of {part['name']} in step '{step['name']}', time step {n + 1}"))
    return [(worst[1] or "momentum", worst[0], FORCE)]


def areas(scene, run):
    """The points of a joint share the rectangle in which its faces meet."""
    sharing, worst = compare.sharing_joints(scene), (0.0, "")
    for joint in scene["joints"]:
        if joint["name"] in sharing:    # its points may be left to the others
            continue
        low, high = geometry.in_common(scene["parts"], joint)
        axis, table = geometry.axis_of(joint["a"][1]), run.tables[f"j_{joint['name']}"]
        area = math.prod(high[i] - low[i] for i in range(3) if i != axis)
        for row in range(len(table)):
            found = sum(table[f"{state}_area"][row] for state in ("open", "stick", "slip"))
            if found > 0.0:    # a damper has none in a static step, nor what is released
                worst = max(worst, (abs(found / area - 1), f"area of {joint['name']}"))
    return [(worst[1] or "areas", worst[0], 1e-6)]
