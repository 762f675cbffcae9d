"""Random scenes against what must be so of them: see README.md.

random_scenes.py PROGRAM [--minutes M] [--seed S] [--out FOLDER] [--scene N] [--relation NAME] [--with TRAIT] [--mpirun FILE]
"""

import argparse
import collections
import datetime
import json
import pathlib
import random
import shutil
import sys
import tempfile
import time

import draw
import relations
import ways_of_running  # noqa: F401, more relations
import shrink
import switched_off
from program import Program
from trial import Trial

AT_ONCE = 6    # relations tried on a scene: more scenes find more than more relations of one


def arguments():
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("program", type=pathlib.Path)
    asked.add_argument("--minutes", type=float, default=2.0)
    asked.add_argument("--seed", type=int, help="of the first scene; by default a new one each day")
    asked.add_argument("--out", type=pathlib.Path, default=pathlib.Path("build/random"), help="where shrunk decks go")
    asked.add_argument("--scene", type=int, help="this scene alone, with all relations")
    asked.add_argument("--relation", action="append", help="only this relation; may be repeated")
    asked.add_argument("--with", dest="switched_on", action="append", default=[], metavar="TRAIT", help="switch on what switched_off.py switches off for this trait; 'all'")
    asked.add_argument("--mpirun")
    asked.add_argument("--no-shrinking", action="store_true")
    asked.add_argument("--verbose", action="store_true")
    asked = asked.parse_args()
    asked.out = asked.out.resolve()
    if "all" in asked.switched_on:
        asked.switched_on = [trait for trait, _, _ in switched_off.SWITCHED_OFF]
    asked.program = asked.program.resolve()
    return asked


class Session:
    def __init__(self, asked):
        self.asked, self.program = asked, Program(asked.program, asked.mpirun)
        self.work = pathlib.Path(tempfile.mkdtemp(prefix="dygita_random_"))
        self.scenes, self.refused, self.off = 0, collections.Counter(), collections.Counter()
        self.verdicts, self.failures, self.worst = collections.defaultdict(collections.Counter), [], {}

    def trial(self, scene, name):
        folder = self.work / name
        shutil.rmtree(folder, ignore_errors=True)
        return Trial(self.program, folder, scene)

    def chosen(self, scene, scene_traits):
        """The relations to try: all that were asked for, else some of those that apply."""
        wanted = [r for r in relations.RELATIONS if (not self.asked.relation or r.name in self.asked.relation) and r.applies(scene)]
        on = []
        for r in wanted:
            reason = switched_off.why_off(scene_traits, r.name, self.asked.switched_on)
            if reason:
                self.off[f"{r.name}: {reason}"] += 1
            else:
                on.append(r)
        if self.asked.relation or self.asked.scene is not None:
            return on
        rng = random.Random(f"relations {scene['seed']}")
        rest = [r for r in on if r.name != "books" and rng.random() < r.share]
        return [r for r in on if r.name == "books"] + rng.sample(rest, min(AT_ONCE - 1, len(rest)))

    def try_scene(self, seed):
        scene = draw.draw(seed)
        scene_traits = switched_off.traits(scene)
        reason = switched_off.why_off(scene_traits, "*", self.asked.switched_on)
        if reason:
            self.off[reason] += 1
            return
        trial = self.trial(scene, "scene")
        base = trial.base()
        self.scenes += 1
        if base.code != 0:
            if base.code in (1, 2, 3):
                self.refused["not converged to 1e-9" if base.code == 1 else f"exit {base.code}: {base.refusal()}"] += 1
                if self.asked.verbose:
                    print(f"  scene {seed}: exit {base.code} {base.refusal()}", flush=True)
            else:
                self.fail(scene, "runs", f"exit {base.code}: {base.refusal()}", lambda t: t.base().code == base.code)
            return
        for r in self.chosen(scene, scene_traits):
            verdict = r.check(trial)
            self.verdicts[r.name][verdict.kind] += 1
            if verdict.kind == "holds" and verdict.size > self.worst.get(r.name, (0, 0))[0]:
                self.worst[r.name] = verdict.size, seed
            if self.asked.verbose:
                print(f"  scene {seed}, {r.name}: {verdict.kind} {verdict.size:.1e} {verdict.text[:160]}", flush=True)
            if verdict.kind == "fails":
                self.fail(scene, r.name, verdict.text, lambda t, check=r.check, applies=r.applies: t.base().code == 0 and applies(t.scene) and check(t).kind == "fails")

    def fail(self, scene, name, text, still_fails):
        folder = self.asked.out / f"scene_{scene['seed']}_{name.replace(' ', '_')}"
        print(f"FAILED: scene {scene['seed']}, {name}: {text}", flush=True)
        small = scene
        if not self.asked.no_shrinking and len(self.failures) < 10:
            small = shrink.shrunk(scene, lambda candidate: still_fails(self.trial(candidate, "shrinking")), 60.0)
        shutil.rmtree(folder, ignore_errors=True)
        trial = Trial(self.program, folder, small)
        again = still_fails(trial)
        text = next((r.check(trial).text for r in relations.RELATIONS if r.name == name), text)
        (folder / "scene.json").write_text(json.dumps(small, indent=1) + "\n")
        runs = "".join(f"{key}: {' '.join(run.command)}\n" for key, run in trial.known.items())
        (folder / "what.txt").write_text(f"{name}: {text}\ntraits: {', '.join(sorted(switched_off.traits(small)))}\n{runs}{'' if again else 'not seen a second time!'}\n")
        print(f"    shrunk to {len(small['parts'])} parts, {len(small['steps'])} steps: {text}\n    {folder}", flush=True)
        self.failures.append((scene["seed"], name, folder))

    def summary(self, first, seconds):
        """Printed, and kept as last.txt."""
        text = "\n".join(self.told(first, seconds))
        print("\n" + text)
        self.asked.out.mkdir(parents=True, exist_ok=True)
        (self.asked.out / "last.txt").write_text(text + "\n")

    def told(self, first, seconds):
        yield f"{self.scenes} scenes from seed {first}, {self.program.n_runs} runs, {sum(sum(c.values()) for c in self.verdicts.values())} relations, {seconds:.0f} s"
        for name, counts in sorted(self.verdicts.items()):
            worst = f", largest difference that holds {self.worst[name][0]:.1e} (scene {self.worst[name][1]})" if name in self.worst else ""
            yield f"  {name}: holds {counts['holds']}, undecided {counts['undecided']}, fails {counts['fails']}{worst}"
        for title, counts in (("not tried", self.refused), ("switched off", self.off)):
            for text, count in counts.most_common():
                yield f"  {title} {count}: {text}"
        for seed, name, folder in self.failures:
            yield f"  FAILED: scene {seed}, {name}: {folder}"
        yield f"{len(self.failures)} failures" + ("; one again: tests/random/random_scenes.py PROGRAM --scene N --relation NAME" if self.failures else "")


def main():
    asked = arguments()
    session = Session(asked)
    first = asked.scene if asked.scene is not None else asked.seed if asked.seed is not None else int(f"{datetime.date.today():%y%m%d}0000")
    print(f"random scenes from seed {first}", flush=True)
    start, seed = time.monotonic(), first
    while True:
        session.try_scene(seed)
        seed += 1
        if asked.scene is not None or time.monotonic() - start > 60 * asked.minutes or len(session.failures) >= 30:
            break
    session.summary(first, time.monotonic() - start)
    shutil.rmtree(session.work, ignore_errors=True)
    sys.exit(1 if session.failures else 0)


if __name__ == "__main__":
    main()
