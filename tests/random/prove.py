"""Can each relation fail? Each is tried on a scene of which it holds, and again on answers that have been spoilt: it must find that.

prove.py PROGRAM [--mpirun FILE]
"""

import argparse
import copy
import pathlib
import shutil
import sys
import tempfile

import draw
import geometry
import relations
import switched_off
import ways_of_running  # noqa: F401, more relations
from program import Program
from trial import Trial


class OtherLoads:
    """As if the program took loads, velocities and shortenings for 1.05 times what the deck says."""

    name = "loads of 1.05 times"

    def scene(self, scene):
        other = copy.deepcopy(scene)
        for part in other["parts"]:
            part["velocity"] = geometry.times(1.05, part["velocity"])
        for step in other["steps"]:
            for load in step["loads"]:
                if load["kind"] != "release":
                    load["value"] = geometry.times(1.05, load["value"]) if isinstance(load["value"], list) else 1.05 * load["value"]
        return other

    def tables(self, run):
        pass


class WrongSign:
    """As if it wrote displacements and forces with the wrong sign."""

    name = "displacements and forces with the wrong sign"

    def scene(self, scene):
        return scene

    def tables(self, run):
        for name, table in run.tables.items():
            if name[:2] in ("u_", "r_"):
                for column in "xyz":
                    table.columns[column] = [-x for x in table[column]]


class OtherEnergy:
    """As if a hundredth of the work of the loads were lost."""

    name = "a hundredth of the work lost"

    def scene(self, scene):
        return scene

    def tables(self, run):
        table = run.tables["energy"]
        table.columns["balance"] = [x - 0.01 * y for x, y in zip(table["balance"], table["loads"])]
        table.columns["loads"] = [0.99 * x for x in table["loads"]]


# What a relation cannot see: the moment of momentum has no displacements and forces, schemes and choices of points differ by more, what is continued takes the right loads.
BLIND = {("moment", WrongSign), ("moment", OtherEnergy), ("explicit", OtherLoads), ("explicit", OtherEnergy), ("tolerance", OtherEnergy), ("continued to a tolerance", OtherLoads),
         ("continued in time", OtherLoads), ("static way", OtherEnergy), ("points", OtherEnergy), ("points", OtherLoads)}


def main():
    asked = argparse.ArgumentParser()
    asked.add_argument("program", type=pathlib.Path)
    asked.add_argument("--mpirun")
    asked.add_argument("--seed", type=int, default=1)
    asked = asked.parse_args()
    program, folder = Program(asked.program.resolve(), asked.mpirun), pathlib.Path(tempfile.mkdtemp(prefix="dygita_prove_"))
    left = [(r, spoil) for r in relations.RELATIONS for spoil in (OtherLoads, WrongSign, OtherEnergy) if (r.name, spoil) not in BLIND and (asked.mpirun or r.name != "ranks")]
    blind = []
    for seed in range(asked.seed, asked.seed + 150):
        scene = draw.draw(seed)
        here = [(r, spoil) for r, spoil in left if r.applies(scene) and (r.name == "points" or not switched_off.why_off(switched_off.traits(scene), r.name))]
        if not here or switched_off.why_off(switched_off.traits(scene), "*") or not moves(scene):
            continue
        plain = Trial(program, folder / "plain", scene)
        shutil.rmtree(folder, ignore_errors=True)
        if plain.base().code != 0:
            continue
        sound = {r.name: r.check(plain).kind == "holds" for r in {r for r, _ in here}}
        for r, spoil in here:
            if not sound[r.name]:
                continue
            shutil.rmtree(folder / "spoilt", ignore_errors=True)
            verdict = r.check(Trial(program, folder / "spoilt", scene, spoil()))
            left.remove((r, spoil))
            print(f"{r.name}, {spoil.name}: {'found' if verdict.kind == 'fails' else 'NOT FOUND'} (scene {seed}) {verdict.text[:100]}", flush=True)
            if verdict.kind != "fails":
                blind.append(f"{r.name}, {spoil.name}")
        if not left:
            break
    shutil.rmtree(folder, ignore_errors=True)
    blind += [f"{r.name}, {spoil.name}: no scene for it" for r, spoil in left]
    print("\n".join(blind) or f"every relation finds what it is for, {program.n_runs} runs")
    sys.exit(1 if blind else 0)


def moves(scene):
    """Has it loads whose forces the books know?"""
    kinds = {load["kind"] for step in scene["steps"] for load in step["loads"]}
    return kinds & {"pressure", "traction", "force", "gravity"} and not kinds & {"velocity", "displacement"}


if __name__ == "__main__":
    main()
