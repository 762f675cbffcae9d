"""Two answers to one question: how far they are apart, by kind of quantity, as a part of the largest value of that kind."""

import math

import geometry
import variations

# Openings are left out: of the points that open and those that close by as much, as where a part rocks, round-off decides which is the largest.
JOINT_COLUMNS = {"normal": "force", "shear": "force", "slip": "length",
                 "friction_work": "energy", "plastic_work": "energy", "damping_work": "energy"}
ENERGIES = ("kinetic", "strain", "loads", "friction", "plastic", "damping", "scheme")
ROUGHLY_NONE = 1e-9    # of the largest force: runs are iterated to 1e-10
VECTORS = {"u": "length", "v": "speed", "p": "momentum", "r": "force"}


def floors(scene):
    """Below these nothing is compared: a millionth of what the loads make of such bodies."""
    pressure = scene["style"]["pressure"]
    young, density = max(m["young"] for m in scene["materials"]), max(m["density"] for m in scene["materials"])
    size = max(max(part["size"]) for part in scene["parts"])
    volume = max(math.prod(part["size"]) for part in scene["parts"])
    speed = pressure / math.sqrt(young * density)
    natural = {"length": pressure / young * size, "speed": speed, "momentum": density * volume * speed, "force": pressure * size**2, "energy": pressure**2 / young * volume}
    return {kind: 1e-6 * value for kind, value in natural.items()}


def sharing_joints(scene):
    """Names of those that meet others at an edge or a point of a part: how they share a force there is not unique, sums over the part are."""
    parts, places = scene["parts"], []
    for joint in scene["joints"]:
        places.append((joint["name"], {joint["a"][0], joint["b"][0]}, geometry.in_common(parts, joint)))
    for support in scene["supports"]:
        for part, face in support["on"]:
            low = [geometry.ends(parts[part], i)[0] for i in range(3)]
            high = [geometry.ends(parts[part], i)[1] for i in range(3)]
            low[geometry.axis_of(face)] = high[geometry.axis_of(face)] = geometry.place_of_face(parts[part], face)
            places.append((support["name"], {part}, (low, high)))
    sharing = set()
    for i, (name, of, (low, high)) in enumerate(places):
        for other, of_other, (other_low, other_high) in places[:i]:
            if of & of_other and name != other and all(min(high[k], other_high[k]) - max(low[k], other_low[k]) > -1e-9 for k in range(3)):
                sharing |= {name, other}
    return sharing


class Answer:
    """A run's tables as series by (table, column), in axes and measure of the scene that is compared with."""

    def __init__(self, scene, run, flipped=(), length=1.0, stress=1.0, merged=None):
        self.scene, self.run, self.series, self.steps = scene, run, {}, {}
        factor = {"length": 1 / length, "speed": 1.0, "momentum": 1 / (stress * length**3), "force": 1 / (stress * length**2), "energy": 1 / (stress * length**3)}
        back = variations.to_scene(scene)
        for name, table in run.tables.items():
            keep = rows_to_keep(table, merged)
            self.steps[name] = [merged[0] if merged and table["step"][i] == merged[1] else table["step"][i] for i in keep]
            prefix, _, of = name.partition("_")
            if name == "energy":
                for column in ENERGIES:
                    self.put(name, column, "energy", [table[column][i] for i in keep], factor)
            elif prefix == "j":
                for column, kind in JOINT_COLUMNS.items():
                    if column in table:
                        self.put(name, column, kind, [table[column][i] for i in keep], factor)
            elif prefix in VECTORS:
                sign = -1.0 if of in flipped else 1.0
                vectors = [geometry.times(sign, geometry.apply(back, v)) for v in (table.vectors()[i] for i in keep)]
                for k, column in enumerate("xyz"):
                    self.put(name, column, VECTORS[prefix], [v[k] for v in vectors], factor)

    def put(self, table, column, kind, values, factor):
        self.series[table, column] = (kind, [value * factor[kind] for value in values])

    def largest(self):
        most = {}
        for kind, values in self.series.values():
            most[kind] = max([most.get(kind, 0.0), *map(abs, values)])
        return most


def rows_to_keep(table, merged):
    """All, but where two steps are compared with one the row of the second's start."""
    rows = list(range(len(table)))
    if not merged:
        return rows
    first, second, n_second = merged
    of_second = table.rows_of(second)
    return [i for i in rows if not (len(of_second) == n_second + 1 and i == of_second[0])]


def lets_go(scene, held, run):
    """Does a part that nothing holds and nothing loads end a static step with no force on it, or between contacts that are all partly open?

    Iteration then has left it somewhere off what it touched (scene 2611280026: 1.27 and 1.47 um), or tilts it as it comes between two edges
    (2611280198: a post without friction, by 0.27 and 0.36 um).
    """
    least = ROUGHLY_NONE * max([1e-30, *(abs(x) for name, table in run.tables.items() if name.startswith("j_") for x in table["normal"])])
    for step in (step for step in scene["steps"] if step["kind"] == "static"):
        loaded = {load["on"][0] for load in step["loads"] if isinstance(load.get("on"), list)}
        for part in set(range(len(scene["parts"]))) - held - loaded:
            tables = [run.tables[f"j_{joint['name']}"] for joint in scene["joints"] if part in (joint["a"][0], joint["b"][0]) and f"j_{joint['name']}" in run.tables]
            ends = [table.rows_of(step["name"])[-1] for table in tables]
            is_off = [abs(table["normal"][end]) <= least and abs(table["shear"][end]) <= least for table, end in zip(tables, ends)]
            is_open = ["open_area" in table and table["open_area"][end] > 0 for table, end in zip(tables, ends)]
            if ends and (all(is_off) or all(is_open)):
                return True
    return False


class Difference:
    def __init__(self, size, where, values):
        self.size, self.where, self.values = size, where, values

    def __str__(self):
        (table, column), row = self.where
        return f"{self.size:.2e} of the largest, in {table}.{column} row {row}: {self.values[0]:.9g} and {self.values[1]:.9g}"


def differences(first, second, leave_out=lambda table, column: False):
    """By kind the largest difference; None where the tables are not of one shape (the second element then says how)."""
    found, scales = {}, {**floors(first.scene)}
    for largest in (first.largest(), second.largest()):
        for kind, value in largest.items():
            scales[kind] = max(scales[kind], value)
    if set(first.series) != set(second.series):
        return None, f"tables or columns: {sorted(set(first.series) ^ set(second.series))[:4]}"
    for name, (kind, values) in first.series.items():
        others = second.series[name][1]
        if first.steps[name[0]] != second.steps[name[0]]:
            return None, f"rows of {name[0]}: {len(values)} and {len(others)}"
        if leave_out(*name):
            continue
        pressed, rubbed = ([side.series.get((name[0], column), ("", []))[1] for side in (first, second)] if name[1] == "slip" else [] for column in ("normal", "friction_work"))
        is_unsure = False
        for row, (a, b) in enumerate(zip(values, others)):
            size = abs(a - b) / scales[kind]
            # Sides that touch and do not press: round-off decides whether they count as closed, and where it has decided otherwise
            # slip is another from then on.
            is_unsure = is_unsure or bool(pressed) and size > 1e-6 and all(abs(of[row]) <= ROUGHLY_NONE * scales["force"] for of in pressed)
            # So it is where a point slides under no force beside one that carries: what differs does a millionth of the work that it would do under all of it.
            is_unsure = is_unsure or bool(rubbed) and size > 1e-6 and abs(rubbed[0][row] - rubbed[1][row]) <= 1e-6 * abs(a - b) * max(abs(of[row]) for of in pressed)
            if is_unsure:
                continue
            if math.isnan(size):
                size = math.inf
            if kind not in found or size > found[kind].size:
                found[kind] = Difference(size, (name, row), (a, b))
    return found, ""


def rms_differences(first, second, leave_out=lambda table, column: False):
    """By kind the largest root mean square over a column, of motions and forces: for two schemes whose fronts are not alike."""
    scales, found = {**floors(first.scene)}, {}
    for kind, value in first.largest().items():
        scales[kind] = max(scales[kind], value)
    for name, (kind, values) in first.series.items():
        others = second.series.get(name, (kind, []))[1]
        if kind == "energy" or name[0][0] == "j" or leave_out(*name) or len(others) != len(values):
            continue
        size = math.sqrt(sum((a - b) ** 2 for a, b in zip(values, others)) / len(values)) / scales[kind]
        row = max(range(len(values)), key=lambda i: abs(values[i] - others[i]))
        if kind not in found or not size <= found[kind].size:
            found[kind] = Difference(size, (name, row), (values[row], others[row]))
    return found
