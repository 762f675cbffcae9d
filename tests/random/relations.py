"""What must be so: each relation with the scenes it is for, its tolerance and the reason for it.

Exact relations have two ways to one discrete answer: they may differ by what iteration leaves (the runs are solved to 1e-9) and by round-off, both times what
the scene makes of it. That is measured where a difference exceeds 1e-5: loads changed by 1e-7 and a tolerance ten times looser move the answer by so much, and
a difference below two hundred times the one or three times the other is the scene's own (Trial.sensitivity).
"""

import random

import books
import compare
import frames
import geometry
import variations
from trial import fails, holds, not_an_answer, undecided


class Relation:
    def __init__(self, name, check, applies, why, share, manners):
        self.name, self.check, self.why, self.share = name, check, why, share
        self.applies = lambda scene: scene["style"]["manner"] in manners and bool(applies(scene))


RELATIONS = []


def relation(name, why, applies=lambda scene: True, share=1.0, manners=("implicit", "explicit", "automatic")):
    """Names a check; share: for which part of the scenes it is made, costs being what they are; manners: for which ways of integrating in time it holds."""
    def put(check):
        RELATIONS.append(Relation(name, check, applies, why, share, manners))
        return check
    return put


def rng_of(trial, name):
    return random.Random(f"{name} {trial.scene['seed']}")


def has_dynamic(scene):
    return any(step["kind"] == "dynamic" for step in scene["steps"])


def has_static(scene):
    return any(step["kind"] == "static" for step in scene["steps"])


def loads_of(scene):
    return [load for step in scene["steps"] for load in step["loads"]]


def judged(found):
    over = sorted(((size / allowed, f"{what}: {size:.2e}, allowed {allowed:.0e}") for what, size, allowed in found), reverse=True)
    return fails(over[0][1], over[0][0]) if over and not over[0][0] <= 1 else holds(over[0][0] if over else 0.0)


@relation("books", "identities of the scheme (E1, S1): exact to what iteration leaves, 1e-5 of the largest energy or force; the scheme may give back 1e-3")
def check_books(trial):
    # A run of its own, since a mutation spoils it.
    run = trial.run("books", spoiled=True) if trial.spoil else trial.base()
    told = not_an_answer(run)
    if told:
        return told
    found = books.energy(trial.scene, run, compare.floors(trial.scene)["energy"]) + books.equilibrium(trial.scene, run) + books.momentum(trial.scene, run) + books.areas(trial.scene, run)
    return judged(found)


@relation("books of monolithic", "as books; Newton's method to 1e-10", manners=("implicit",))
def check_books_of_monolithic(trial):
    run = trial.run("monolithic", solver="monolithic{}", spoiled=True)
    told = not_an_answer(run)
    # At rest on a contact its increments leave 1e-10 of the strain energy each, where LATIN's leave none.
    return told or judged(books.energy(trial.scene, run, compare.floors(trial.scene)["energy"], least_motion=1e-5) + books.equilibrium(trial.scene, run) + books.momentum(trial.scene, run) + books.areas(trial.scene, run))


@relation("monolithic", "exact: one discrete problem, two methods, where all is implicit", manners=("implicit",))
def check_monolithic(trial):
    return trial.compare(trial.run("monolithic", solver="monolithic{}", spoiled=True))


@relation("turned by quarters", "exact: no axis is special")
def check_turned_by_quarters(trial):
    scene = variations.turned(trial.scene, geometry.quarter_turn(rng_of(trial, "quarter")))
    return trial.compare(trial.run("turned_by_quarters", scene, spoiled=True), scene)


@relation("turned obliquely", "exact but for round-off of places, 1e-16 of a metre on cells of a millimetre")
def check_turned_obliquely(trial):
    scene = variations.turned(trial.scene, geometry.oblique_turn(rng_of(trial, "oblique")))
    return trial.compare(trial.run("turned_obliquely", scene, spoiled=True), scene)


@relation("moved", "exact but for round-off of places, 1e-16 of a metre on cells of a millimetre", share=0.5)
def check_moved(trial):
    rng = rng_of(trial, "moved")
    scene = variations.moved(trial.scene, [round(rng.uniform(-2, 2), 3) for _ in range(3)])
    return trial.compare(trial.run("moved", scene, spoiled=True), scene)


@relation("mirrored", "exact where the mesh is its own mirror image: hexahedra, and prisms along their axis",
          applies=lambda scene: any(variations.can_be_mirrored(scene, axis) for axis in range(3)))
def check_mirrored(trial):
    axes = [axis for axis in range(3) if variations.can_be_mirrored(trial.scene, axis)]
    scene = variations.mirrored(trial.scene, rng_of(trial, "mirrored").choice(axes))
    return trial.compare(trial.run("mirrored", scene, spoiled=True), scene)


@relation("scaled", "exact: twice as long in space and time, four times as stiff and heavy, is similar; powers of two have no round-off, absolute tolerances show", share=0.7)
def check_scaled(trial):
    rng = rng_of(trial, "scaled")
    length, stress = rng.choice((1 / 32, 0.125, 2.0, 8.0)), rng.choice((1.0, 0.25, 2.0))
    scene = variations.scaled(trial.scene, length, stress)
    return trial.compare(trial.run("scaled", scene, spoiled=True), scene, length=length, stress=stress)


@relation("reordered", "exact: what is declared, listed and named first does not matter", applies=lambda scene: len(scene["parts"]) > 1)
def check_reordered(trial):
    return trial.compare(trial.run("reordered", order=rng_of(trial, "reordered"), spoiled=True))


@relation("swapped", "exact where the meshes match; else the mesh's own error, measured by cells of half the size", applies=lambda scene: scene["joints"])
def check_swapped(trial):
    scene = variations.swapped(trial.scene)
    flipped = {joint["name"] for joint in scene["joints"]}
    verdict = trial.compare(trial.run("swapped", scene, spoiled=True), scene, flipped=flipped)
    if verdict.kind != "fails" or all(geometry.nodes_coincide(trial.scene["parts"], joint) for joint in trial.scene["joints"]):
        return verdict
    return within_error_of_mesh(trial, verdict)


def within_error_of_mesh(trial, verdict):
    """A difference that must not exceed half of what cells of half the size change."""
    finer = trial.run("finer", variations.refined(trial.scene))
    if finer.code != 0:
        return undecided("no finer run")
    found, why = compare.differences(compare.Answer(trial.scene, trial.base()), compare.Answer(trial.scene, finer), trial.leave_out)
    if found is None:
        return undecided(why)
    error = max(d.size for d in found.values())
    return holds(verdict.size) if verdict.size <= 0.5 * error else fails(f"{verdict.text} (finer cells change {error:.2e})", verdict.size)


@relation("points", "the mesh's own error: points on the face that lies within the other, or at the choice of the program; measured by cells of half the size",
          applies=lambda scene: any(inner_side(scene, joint) for joint in scene["joints"]))
def check_points(trial):
    scene = variations.with_points(trial.scene, inner_side)
    verdict = trial.compare(trial.run("points", scene, spoiled=True), scene, allowed=0.02)
    return within_error_of_mesh(trial, verdict) if verdict.kind == "fails" else verdict


def inner_side(scene, joint):
    """'first' or 'second': the face that lies within the other of unlike meshes; None where neither or both do."""
    if geometry.nodes_coincide(scene["parts"], joint):
        return None
    (a, face), (b, _) = joint["a"], joint["b"]
    within = [geometry.lies_within(scene["parts"][x], scene["parts"][y], face) for x, y in ((a, b), (b, a))]
    return None if within[0] == within[1] else ("first", "second")[within[1]]


@relation("cut", "exact: pieces are bonded again; iterated to the tolerance (explicit ones have increments and a tuned mass of their own)", manners=("implicit",),
          applies=lambda scene: any(part["cells"][0] * part["cells"][1] * part["cells"][2] >= 16 for part in scene["parts"]))
def check_cut(trial):
    return trial.compare(trial.run("cut", solver=trial.latin(pieces=str(rng_of(trial, "cut").randint(2, 3))), spoiled=True))


@relation("window", "exact: time steps iterated together have the answer of one after the other", applies=has_dynamic, share=0.5, manners=("implicit",))
def check_window(trial):
    return trial.compare(trial.run("window", solver=trial.latin(window=str(rng_of(trial, "window").choice((2, 3, 5)))), spoiled=True))


@relation("static way", "exact: all parts in one system, or part by part; 1e-3, since their indicators are measured against all work so far, that of yielding too", applies=has_static, share=0.7)
def check_static_way(trial):
    verdicts = [trial.compare(trial.run(way, solver=trial.latin(static_steps=f'"{way}"'), spoiled=True), allowed=1e-3) for way in ("assembled", "iterated")]
    return min(verdicts, key=lambda verdict: ("fails", "undecided", "holds").index(verdict.kind))


@relation("chained", "exact: a step in two parts whose loads go on is one step; what is explicit or tuned may be chosen by the loads of a step",
          applies=lambda scene: can_be_chained(scene), manners=("implicit", "explicit"))
def check_chained(trial):
    k = next(k for k, step in enumerate(trial.scene["steps"]) if step["kind"] == "dynamic")
    n = rng_of(trial, "chained").randint(1, trial.scene["steps"][k]["n"] - 1)
    scene = variations.chained(trial.scene, k, n)
    first, second = scene["steps"][k], scene["steps"][k + 1]
    return trial.compare(trial.run("chained", scene, spoiled=True), scene, merged=(first["name"], second["name"], second["n"]))


def can_be_chained(scene):
    """Displacement loads are smoothed over half a step either way at the ends of a step."""
    return has_dynamic(scene) and not any(load["kind"] == "displacement" for load in loads_of(scene))


@relation("spelt out", "exact: a pattern is its parts one by one", applies=lambda scene: scene["patterns"])
def check_spelt_out(trial):
    return trial.compare(trial.run("spelt_out", spelled=True, spoiled=True))


@relation("found", "exact: faces found where two parts touch are those that one would name", applies=lambda scene: scene["joints"], share=0.4)
def check_found(trial):
    return trial.compare(trial.run("found", found=True, spoiled=True))


@relation("tolerance", "what is left to users' tolerance (1e-6 in motion, 1e-8 at rest): one per cent of each kind of quantity; what is explicit may be chosen by the tolerance",
          manners=("implicit", "explicit"))
def check_tolerance(trial):
    usual = trial.latin(tolerance="1e-6", static_tolerance="1e-8")
    return trial.compare(trial.run("tolerance", solver=usual, spoiled=True), allowed=1e-2)


@relation("moment", "exact: in free flight the moment of momentum is that of the start and of the loads; 1e-5 of its largest part; tuned masses are not known here", applies=has_dynamic,
          share=0.5, manners=("implicit", "explicit"))
def check_moment(trial):
    scene = variations.freed(trial.scene)
    run = trial.run("moment", scene, frames=scene["steps"][0]["n"], more=("--no-state",), spoiled=True)
    if run.code == 2:
        return undecided("cannot fly freely")
    return not_an_answer(run) or judged(frames.moment_of_momentum(scene, run))
