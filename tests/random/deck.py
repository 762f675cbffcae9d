"""Writes a scene as a Lua deck."""

import geometry
import histories


def number(x):
    return repr(float(x)) if not float(x).is_integer() or abs(x) > 1e15 else str(int(x))


def vector(v):
    return "{ " + ", ".join(number(x) for x in v) + " }"


def arguments(args):
    return "".join(f", {name} = {str(value).lower() if isinstance(value, bool) else number(value)}" for name, value in args.items())


class Writer:
    """One way to write a scene: its orientation, an order of declarations, patterns spelt out, a part condensed, interfaces between parts whose faces are found."""

    def __init__(self, scene, order=None, spelled=False, condensed=None, found=False, frames=0):
        self.scene, self.order, self.spelled, self.condensed, self.found, self.frames = scene, order, spelled, condensed, found, frames
        self.turn, self.shift = scene["orientation"], scene.get("translation", [0.0, 0.0, 0.0])
        self.lines = []

    def ordered(self, items):
        items = list(items)
        if self.order:
            self.order.shuffle(items)
        return items

    def turned(self, v):
        return geometry.apply(self.turn, v)

    def part(self, i):
        for k, pattern in enumerate([] if self.spelled else self.scene["patterns"]):
            if i in pattern["members"]:
                return f"L{k}[{pattern['members'].index(i) + 1}]"
        return self.scene["parts"][i]["name"]

    def face(self, side):
        return f'{self.part(side[0])}:face "{side[1]}"'

    def side(self, side):
        return self.part(side[0]) if self.found else self.face(side)

    def faces(self, sides):
        return "{ " + ", ".join(self.face(side) for side in self.ordered(sides)) + " }"

    def place(self):
        axis, angle = geometry.axis_and_angle(self.turn)
        return f"place = {{ translate = {vector(self.shift)}, rotate = {{ axis = {vector(axis)}, angle = {number(angle)} }} }}"

    def materials(self):
        for m in self.scene["materials"]:
            damping = f", damping = {{ mass = {number(m['damping'].get('mass', 0))}, stiffness = {number(m['damping']['stiffness'])} }}" if m["damping"] else ""
            self.lines.append(f'local {m["name"]} = material.elastic{{ name = "{m["name"]}", young = {number(m["young"])}, poisson = {number(m["poisson"])}, '
                              f'density = {number(m["density"])}{damping} }}')

    def substructure(self, i):
        part = self.scene["parts"][i]
        velocity = f", velocity = {vector(self.turned(part['velocity']))}" if any(part["velocity"]) else ""
        name, material = part["name"], self.scene["materials"][part["material"]]["name"]
        if self.condensed == i:
            self.lines.append(f'local {name} = substructure.superelement{{ name = "{name}", file = "condensed/element.json", {self.place()}{velocity} }}')
            return
        order = 1 if part["cell"] in geometry.LINEAR else 2
        self.lines.append(f'local {name} = substructure{{ name = "{name}", material = {material}, mesh = mesh.box{{ origin = {vector(part["origin"])}, '
                          f'size = {vector(part["size"])}, cells = {vector(part["cells"])}, cell = "{part["cell"]}", order = {order} }}, {self.place()}{velocity} }}')

    def parts(self):
        patterns = {} if self.spelled else {p["members"][0]: (k, p) for k, p in enumerate(self.scene["patterns"])}
        copies = set() if self.spelled else {i for p in self.scene["patterns"] for i in p["members"][1:]}
        for i in self.ordered(i for i in range(len(self.scene["parts"])) if i not in copies):
            self.substructure(i)
            if i in patterns:
                k, pattern = patterns[i]
                self.lines.append(f"local L{k} = pattern.line{{ of = {self.scene['parts'][i]['name']}, n = {len(pattern['members'])}, step = {vector(self.turned(pattern['step']))} }}")

    def joints(self):
        for joint in self.ordered(self.scene["joints"]):
            points = f', points = "{joint["points"]}"' if "points" in joint else ""
            self.lines.append(f'local {joint["name"]} = interface.{joint["law"]}{{ name = "{joint["name"]}", between = {{ {self.side(joint["a"])}, {self.side(joint["b"])} }}'
                              f'{arguments(joint["args"])}{points} }}')
        for support in self.ordered(self.scene["supports"]):
            self.lines.append(f'local {support["name"]} = support.{support["kind"]}{{ name = "{support["name"]}", on = {self.faces(support["on"])}{arguments(support["args"])} }}')

    def value(self, load, value):
        history = load["history"]
        if history is None:
            return number(value)
        text = histories.lua(history, value, number)
        return f"({text}):shifted({number(-history['before'])})" if history.get("before") else text

    def load(self, load):
        kind, on = load["kind"], load["on"]
        joint = self.scene["joints"][on]["name"] if kind in ("preload", "shortening", "release") else ""
        if kind == "preload":
            return f"load.preload{{ on = {joint}, force = {number(load['value'])} }}"
        if kind == "shortening":
            return f"load.shortening{{ on = {joint}, by = {number(load['value'])} }}"
        if kind == "release":
            return f"load.release{{ on = {joint}, at = {number(load['value'])} }}"
        if kind == "base_acceleration":
            peak = geometry.norm(load["value"])
            return (f"load.base_acceleration{{ on = {self.scene['supports'][on]['name']}, direction = {vector(self.turned(load['value']))}, "
                    f"history = {self.value(load, peak)} }}")
        if kind == "pressure":
            return f"load.pressure{{ on = {self.face(on)}, history = {self.value(load, load['value'])} }}"
        if kind == "torque":
            return f"load.torque{{ on = {self.face(on)}, axis = {vector(self.turned(load['axis']))}, history = {self.value(load, load['value'])} }}"
        components = ", ".join(f"{x} = {self.value(load, v)}" for x, v in zip("xyz", self.turned(load["value"])))
        place = "" if kind == "gravity" else f"on = {self.face(on)}, "
        return f"load.{kind}{{ {place}{components} }}"

    def steps(self):
        before = None
        for step in self.scene["steps"]:
            after = f", after = {before}" if before else ""
            what = f"increments = {step['increments']}" if step["kind"] == "static" else f"duration = {step['n']} * {number(step['dt'])}, dt = {number(step['dt'])}"
            loads = ",\n  ".join(self.ordered(self.load(load) for load in step["loads"]))
            supports = ", supports = {}" if step.get("let_go") else ""
            self.lines.append(f'local {step["name"]} = step.{step["kind"]}{{ name = "{step["name"]}"{after}, {what}{supports}, loads = {{\n  {loads} }} }}')
            before = step["name"]

    def outputs(self):
        outputs = ["output.energy{}"]
        for joint in self.scene["joints"] + self.scene["supports"]:
            outputs.append(f'output.resultant{{ name = "r_{joint["name"]}", on = {joint["name"]} }}')
            if joint.get("kind", "wall") == "wall":
                outputs.append(f'output.joint{{ name = "j_{joint["name"]}", on = {joint["name"]} }}')
        for i, part in enumerate(self.scene["parts"]):
            name = part["name"]
            outputs.append(f'output.momentum{{ name = "p_{name}", of = {self.part(i)} }}')
            outputs.append(f'output.history{{ name = "u_{name}", on = {self.face([i, part["watched"]["u"]])}, quantity = "displacement" }}')
            outputs.append(f'output.history{{ name = "v_{name}", on = {self.face([i, part["watched"]["v"]])}, quantity = "velocity" }}')
        if self.frames:
            outputs.append(f'output.vtk{{ frames = {self.frames}, fields = {{ "velocity" }} }}')
        return outputs

    def text(self):
        self.materials()
        self.parts()
        self.joints()
        self.steps()
        parts = ", ".join(self.ordered(self.part(i) for i in range(len(self.scene["parts"]))))
        joints = ", ".join(self.ordered(joint["name"] for joint in self.scene["joints"]))
        supports = ", ".join(self.ordered(support["name"] for support in self.scene["supports"]))
        steps = ", ".join(step["name"] for step in self.scene["steps"])
        outputs = ",\n  ".join(self.ordered(self.outputs()))
        self.lines.append(f'problem{{ name = "scene", substructures = {{ {parts} }}, interfaces = {{ {joints} }}, supports = {{ {supports} }}, '
                          f'steps = {{ {steps} }}, outputs = {{\n  {outputs} }} }}:run{{}}')
        return "\n".join(self.lines) + "\n"


def condensing(scene, i):
    """The deck that makes a superelement of one part, with all its modes, about its state at rest; its faces move node by node."""
    writer = Writer({**scene, "orientation": geometry.IDENTITY, "translation": [0.0, 0.0, 0.0], "patterns": []})
    writer.materials()
    writer.substructure(i)
    name = scene["parts"][i]["name"]
    faces = sorted({side[1] for joint in scene["joints"] + [{"a": on, "b": on} for support in scene["supports"] for on in support["on"]] for side in (joint["a"], joint["b"])
                    if side[0] == i} | set(scene["parts"][i]["watched"].values())
                   | {load["on"][1] for step in scene["steps"] for load in step["loads"] if isinstance(load["on"], list) and load["on"][0] == i})
    on = ", ".join(f'{name}:face "{face}"' for face in faces)
    writer.lines.append(f'problem{{ name = "condense", substructures = {{ {name} }}, steps = {{ step.static{{ name = "rest" }} }}, '
                        f'outputs = {{ output.superelement{{ name = "element", on = {{ {on} }}, modes = 2000, motion = "nodes" }} }} }}:run{{}}')
    return "\n".join(line.replace(f", velocity = {vector(scene['parts'][i]['velocity'])}", "") for line in writer.lines) + "\n"
