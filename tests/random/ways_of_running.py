"""Relations between ways of running one scene: continued, on several ranks, with a part condensed, by the explicit solver."""

import shutil

import compare
import deck
import geometry
import variations
from relations import has_dynamic, loads_of, relation, rng_of, within_error_of_mesh
from trial import EXACT, fails, holds, not_an_answer, undecided


@relation("continued to a tolerance", "exact: a run iterated further is one that was iterated so far at first", share=0.4, manners=("implicit",))
def check_continued_to_a_tolerance(trial):
    run = trial.run("continued_to_a_tolerance", solver=trial.latin(tolerance="1e-4", static_tolerance="1e-7"), more=("--no-frames",))
    return continued(trial, run, "--tolerance", "1e-9")


@relation("continued in time", "exact: a run that goes on is one that was as long at first", manners=("implicit", "explicit"),
          applies=lambda scene: scene["steps"][-1]["kind"] == "dynamic" and not any(load["kind"] == "release" for load in loads_of(scene)), share=0.4)
def check_continued_in_time(trial):
    scene = {**trial.scene, "steps": [dict(step) for step in trial.scene["steps"]]}
    last = scene["steps"][-1]
    end = sum(step["n"] * step["dt"] for step in scene["steps"] if step["kind"] == "dynamic")
    last["n"] = rng_of(trial, "until").randint(1, last["n"] - 1) if last["n"] > 1 else 1
    return continued(trial, trial.run("continued_in_time", scene, more=("--no-frames",)), "--until", f"{end:.12g}")


def continued(trial, run, *how):
    if run.code not in (0, 1):
        return not_an_answer(run)
    command = [trial.program.path, "continue", str(run.out), *how, "--threads", "1", "--quiet", "--no-frames"]
    again = trial.program.call(run.folder, command)
    if trial.spoil:
        trial.spoil.tables(again)
    return trial.compare(again)


@relation("ranks", "bits where no two parts are equal; else exact, since equal parts are solved together", applies=lambda scene: len(scene["parts"]) > 1, share=0.15)
def check_ranks(trial):
    if not trial.program.mpirun:
        return undecided("no mpirun")
    run = trial.run("ranks", ranks=2, spoiled=True)
    told = not_an_answer(run)
    if told:
        return told
    parts = [repr({**part, "name": "", "origin": "", "velocity": ""}) for part in trial.scene["parts"]]
    if len(set(parts)) < len(parts):
        return trial.compare(run)
    other = [name for name, table in run.tables.items() if table.columns != trial.base().tables[name].columns]
    return fails(f"other bits than those of one process: {', '.join(other[:5])}") if other else holds()


def can_be_condensed(scene, i):
    """Patterns share one mesh; a non-reflecting support asks its part for a material, which a superelement has not."""
    absorbs = any(support["kind"] == "absorbing" and any(part == i for part, _ in support["on"]) for support in scene["supports"])
    return not absorbs and not any(i in pattern["members"] for pattern in scene["patterns"])


@relation("condensed", "exact: a superelement with all its modes is its mesh in other unknowns, always implicit", share=0.4, manners=("implicit",),
          applies=lambda scene: any(can_be_condensed(scene, i) for i in range(len(scene["parts"]))))
def check_condensed(trial):
    i = rng_of(trial, "condensed").choice([i for i in range(len(trial.scene["parts"])) if can_be_condensed(trial.scene, i)])
    folder, results = trial.folder / "condensed", trial.folder / "condense" / "out" / "condense" / "base"
    made = trial.program.run(trial.folder / "condense", deck.condensing(trial.scene, i), trial.latin())
    if made.code != 0:
        return fails(f"{trial.scene['parts'][i]['name']} cannot be condensed: exit {made.code} {made.refusal()}")
    if not (results / "element.json").exists():
        return undecided("not made: its faces have all of its nodes, which the run says")
    (folder / "condensed").mkdir(parents=True, exist_ok=True)
    for file in results.glob("element*"):
        shutil.copy(file, folder / "condensed")
    # A superelement has no material, which decides between faces that are alike: its own have the points in both runs.
    scene = variations.with_points(trial.scene, lambda _, joint: "first" if joint["a"][0] == i else "second" if joint["b"][0] == i else None)
    plain = trial.run("to_be_condensed", scene)
    told = not_an_answer(plain)
    return told or trial.compare(trial.run("condensed", scene, condensed=i, spoiled=True), scene, against=plain, allowed=10 * EXACT)


EXPLICIT = 'explicit{{ penalty = {penalty}, integration = "full", bulk_viscosity = false }}'
SCHEME = {"length": 0.2, "speed": 0.2, "momentum": 0.2, "force": 0.4}    # of the largest, root mean square over time


@relation("explicit", "another scheme and another contact: at a quarter of dt a fifth of the largest motion, two fifths of the largest force, in the mean over time; "
          "more decides nothing where a quarter of that dt and a contact ten times stiffer bring the two nearer, or cells of half the size change as much",
          applies=lambda scene: has_dynamic(scene) and all(part["cell"] in geometry.LINEAR for part in scene["parts"]), share=0.3)
def check_explicit(trial):
    told, beyond = beyond_scheme(trial, 4, 10)
    if told or not beyond:
        return told or holds()
    told, still = beyond_scheme(trial, 16, 100)
    kind, worst = max(beyond.items(), key=lambda item: item[1].size)
    if told or kind not in still or still[kind].size < 0.75 * worst.size:
        return undecided("still converging")
    return within_error_of_mesh(trial, fails(f"{kind} {worst} (root mean square)", worst.size))


def beyond_scheme(trial, by, penalty):
    finer = variations.with_finer_steps(trial.scene, by)
    first, second = trial.run(f"steps_{by}", finer), trial.run(f"explicit_{by}", finer, solver=EXPLICIT.format(penalty=penalty), spoiled=True)
    if 4 in (first.code, second.code):
        return fails("an error of the program"), {}
    if first.code != 0 or second.code != 0:
        return undecided("refused by one of the two"), {}
    found = compare.rms_differences(compare.Answer(finer, first), compare.Answer(finer, second), trial.leave_out)
    return None, {kind: d for kind, d in found.items() if not d.size <= SCHEME[kind]}
