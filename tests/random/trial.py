"""A scene being tried: its runs, each made once, and how sharply it is determined."""

import compare
import geometry
import switched_off
import variations
from deck import Writer
from program import latin

EXACT = 1e-5        # relations that hold exactly: a thousand times what iteration (1e-9) and round-off leave
UNDECIDED = 1e-2    # a scene in which as much may come of its own sensitivity decides nothing
NUDGE = 1e-7


class Verdict:
    """holds, fails, or undecided; what a relation has to say, and how far it was from its limit."""

    def __init__(self, kind, text="", size=0.0):
        self.kind, self.text, self.size = kind, text, size

    def __bool__(self):
        return self.kind != "fails"


def holds(size=0.0):
    return Verdict("holds", "", size)


def fails(text, size=float("inf")):
    return Verdict("fails", text, size)


def undecided(text):
    return Verdict("undecided", text)


class Trial:
    def __init__(self, program, folder, scene, spoil=None):
        self.program, self.folder, self.scene, self.spoil = program, folder, scene, spoil
        self.sharing = compare.sharing_joints(scene)
        self.smooth = {joint["name"] for joint in scene["joints"] + scene["supports"] if joint["args"].get("friction") == 0}
        self.is_pressed_first = scene["steps"][0]["kind"] == "static"
        self.known, self.moves = {}, None

    def run(self, name, scene=None, solver=None, spoiled=False, **words):
        """A run of the scene or of a variation, in a folder of its own; made once."""
        if name not in self.known:
            writer = {key: words.pop(key) for key in ("order", "spelled", "condensed", "found", "frames") if key in words}
            scene = scene or self.scene
            if spoiled and self.spoil:
                scene = self.spoil.scene(scene)
            run = self.program.run(self.folder / name, Writer(scene, **writer).text(), solver or self.latin(), **words)
            if spoiled and self.spoil:
                self.spoil.tables(run)
            self.known[name] = run
        return self.known[name]

    def latin(self, **changes):
        """The solver as the scene has it, with changes."""
        return latin(self.scene["style"]["manner"], **changes)

    def base(self):
        return self.run("base")

    def leave_out(self, table, column):
        """Forces and works of joints that share them with others are not unique; motions are. Slip is counted from the first touch: round-off decides it where nothing rubs or nothing was pressed at first."""
        joint = table.partition("_")[2]
        return table[0] in "rj" and (joint in self.sharing or column == "slip" and (joint in self.smooth or not self.is_pressed_first))

    def sensitivity(self):
        """By kind of quantity: what the answer moves by where loads are changed by 1e-7, and where it is iterated ten times less closely."""
        if self.moves is None:
            first = compare.Answer(self.scene, self.base())
            self.moves = {}
            for name, run, weight in (("nudged", self.run("nudged", variations.nudged(self.scene, NUDGE, 1)), 200.0),
                                      ("nudged_again", self.run("nudged_again", variations.nudged(self.scene, NUDGE, 2)), 200.0),
                                      ("looser", self.run("looser", solver=self.latin(tolerance="1e-8", static_tolerance="1e-9")), 3.0)):
                found, _ = compare.differences(first, compare.Answer(self.scene, run), self.leave_out) if run.code in (0, 1) else (None, "")
                for kind in compare.floors(self.scene):
                    moved = found[kind].size if found and kind in found else 0.0 if found else 1.0
                    self.moves[kind] = max(self.moves.get(kind, 0.0), weight * moved)
        return self.moves

    def compare(self, run, scene=None, allowed=EXACT, sensitive=True, against=None, **how):
        """The verdict on a run that must have the answer of the base (or of `against`)."""
        against = against or self.base()
        told = not_an_answer(run)
        if told:
            return told
        if run.increments() != against.increments():
            return undecided("other increments of explicit parts")
        second = compare.Answer(scene or self.scene, run, **how)
        found, why = compare.differences(compare.Answer(self.scene, against), second, self.leave_out)
        if found is None:
            return fails(f"other {why}")
        if not found:
            return fails("nothing to compare")
        if compare.lets_go(self.scene, switched_off.held_parts(self.scene), against):
            return undecided("a part is loose at the end of a static step: no place of it is the right one")
        worst = max(found.values(), key=lambda d: d.size)
        if worst.size <= allowed:
            return holds(worst.size)
        beyond = {kind: d for kind, d in found.items() if d.size > allowed}
        if sensitive:
            moves = self.sensitivity()
            beyond = {kind: d for kind, d in beyond.items() if d.size > allowed + moves[kind]}
            if not beyond or min(moves[kind] for kind in beyond) > UNDECIDED:
                return undecided("sensitive") if max(moves.values()) > UNDECIDED or not beyond else holds(worst.size)
        return fails("; ".join(f"{kind} {d}" for kind, d in sorted(beyond.items(), key=lambda item: -item[1].size)), worst.size)


def not_an_answer(run):
    """None for a run with an answer; what stopped is a fault where the base has run through, what has not converged decides nothing."""
    if run.code == 1:
        return undecided("not converged")
    if run.code == 2 and "plausible range" in run.text:
        return undecided("beyond what decks take for plausible")
    if run.code != 0:
        return fails(f"exit {run.code} where the first run is accepted: {run.refusal()}")
    return None
