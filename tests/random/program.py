"""Runs dygita and reads what it has written."""

import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import time

# What all runs that are compared are solved with: each increment to far below what is compared.
TIGHT = {"tolerance": "1e-9", "static_tolerance": "1e-10", "precision": '"double"', "pieces": "1"}
SECONDS = 120    # a run that takes longer hangs: scenes take about a second


MANNERS = {"implicit": {"integration": '"implicit"'}, "explicit": {"integration": '"explicit"', "mass": '"lumped"'}, "automatic": {}}


def latin(manner="implicit", **changes):
    return "latin{ " + ", ".join(f"{name} = {value}" for name, value in {**MANNERS[manner], **TIGHT, **changes}.items()) + " }"


class Table:
    def __init__(self, path):
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        names = [re.sub(r" \[.*\]$", "", name) for name in rows[0]]
        self.columns = {}
        for k, name in enumerate(names):
            texts = [row[k] for row in rows[1:]]
            self.columns[name] = texts if name == "step" else [float(text) for text in texts]

    def __getitem__(self, name):
        return self.columns[name]

    def __contains__(self, name):
        return name in self.columns

    def __len__(self):
        return len(self["step"])

    def vectors(self):
        return [list(v) for v in zip(self["x"], self["y"], self["z"])]

    def rows_of(self, step):
        return [i for i, name in enumerate(self["step"]) if name == step]


class Run:
    """What a command has answered; tables by the names of their files."""

    def __init__(self, folder, command, code, text, seconds):
        self.folder, self.command, self.code, self.text, self.seconds = folder, command, code, text, seconds
        self.out = folder / "out" / "scene" / "base"
        self.tables, self.record = {}, {}
        if code in (0, 1) and (self.out / "run.json").exists():
            self.tables = {path.stem: Table(path) for path in sorted(self.out.glob("*.csv")) if path.stem not in ("convergence", "bolts")}
            self.record = json.loads((self.out / "run.json").read_text())

    def increments(self):
        """How many explicit increments a dt has, and of which mass: chosen by limits of stability that are known to a per cent."""
        return {("tuned" in line, int(n)) for line, n in re.findall(r"(explicit[^\n]*?), (\d+) substeps? of each dt", self.text)}

    def refusal(self):
        """The first line of the error, without numbers, to count by kind."""
        lines = [line for line in self.text.splitlines() if line.strip()]
        said = next((line for line in lines if "error" in line.lower()), lines[-1] if lines else "nothing said")
        return re.sub(r"[-+]?\d[\d.e+-]*", "#", re.sub(r"^.*?\.lua:\d+: ", "", said))[:160]


class Program:
    def __init__(self, path, mpirun=None):
        self.path, self.mpirun, self.n_runs = str(path), mpirun, 0

    def command(self, deck, solver, ranks=1, more=()):
        start = [self.mpirun, "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        return [*start, self.path, "run", str(deck), "--out", str(deck.parent / "out"), *(["--solver", solver] if solver else []), "--threads", "1", "--quiet", *more]

    def call(self, folder, command):
        start = time.monotonic()
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        self.n_runs += 1
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False, env=environment, cwd=folder)
            code, text = done.returncode, done.stdout + done.stderr
        except subprocess.TimeoutExpired:
            code, text = "hangs", f"no end after {SECONDS} s"
        return Run(folder, command, code, text, time.monotonic() - start)

    def run(self, folder, deck, solver=None, ranks=1, more=("--no-frames", "--no-state")):
        folder = pathlib.Path(folder)
        shutil.rmtree(folder / "out", ignore_errors=True)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "deck.lua").write_text(deck)
        return self.call(folder, self.command(folder / "deck.lua", solver, ranks, more))
