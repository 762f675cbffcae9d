"""Runs the program on a deck and reads back what it printed and what it wrote."""

import csv
import json
import os
import re
import resource
import statistics
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

NUMBER = r"[-+]?(?:\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?|inf|nan)"
LABELLED = re.compile(rf"\s*(.+?):\s+({NUMBER})(?=[\s;,]|$)")


def parse_numbers(text):
    """Numbers of "label: number unit" lines, by their labels; several on a line are parted by ";".

    A label may hold colons itself: it ends at the last one before a number. Where a label is printed twice the last counts.
    """
    numbers = {}
    for line in text.splitlines():
        for segment in line.split(";"):
            cuts = [m.end() for m in re.finditer(rf":\s+(?={NUMBER}(?:[\s,%]|$))", segment)]
            if cuts:
                label = segment[:cuts[-1]].strip().rstrip(":").strip()
                numbers[label] = float(re.match(NUMBER, segment[cuts[-1]:]).group())
    return numbers


def read_table(path):
    """Columns of a CSV of the program by name without unit; `step` is an array of names, the rest of numbers."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    names = [re.sub(r"\s*\[.*\]$", "", name) for name in rows[0]]
    columns = list(zip(*rows[1:])) or [()] * len(names)
    return {n: np.array(c) if n == "step" else np.array(c, dtype=float) for n, c in zip(names, columns)}


@dataclass
class Run:
    """One command `dygita run`: its exit code, what it printed and the folder of each of its cases."""

    exit_code: int          # None: stopped at the time limit
    text: str
    cases: dict             # folder of each case, in the order of computation
    share: float = 1.0      # processor time over elapsed time, at most 1: what a busy machine left to a run on one thread

    def number(self, label):
        """The number printed after the first label that holds `label`; KeyError where none does."""
        for known, value in parse_numbers(self.text).items():
            if label in known:
                return value
        raise KeyError(f"the deck prints no '{label}':\n{self.text[-2000:]}")

    def _case(self, case):
        return self.cases[case or next(iter(self.cases))]

    def record(self, case=None):
        """run.json of a case, by default of the first."""
        return json.loads((self._case(case) / "run.json").read_text())

    def table(self, output, case=None):
        """The CSV of an output; see read_table."""
        return read_table(self._case(case) / f"{output}.csv")

    def figure(self, name, case=None):
        """A figure of run.json, or None where this solver has none of that name."""
        return self.record(case)["figures"].get(name)


def seconds(record):
    """Seconds of computation: all phases of run.json but the output."""
    return sum(s for phase, s in record["seconds"].items() if phase not in ("all", "output"))


def processor_seconds():
    """Processor time (s) of all programs run so far; runs that are timed go one at a time."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Program:
    """The program `dygita` and a folder for its results."""

    def __init__(self, path, root, scratch):
        self.path, self.root, self.scratch = Path(path), Path(root), Path(scratch)
        help_text = subprocess.run([path, "run", "--help"], capture_output=True, text=True, check=True).stdout
        self.schema = subprocess.run([path, "schema"], capture_output=True, text=True, check=True).stdout
        self.takes_solver = "--solver" in help_text
        self.takes_no_frames = "--no-frames" in help_text
        self.count = 0

    def has_solver(self, name):
        """Whether decks may write solver.<name>."""
        return self.takes_solver and f"solver.{name}{{" in self.schema.replace(" ", "")

    def solvers(self):
        """{name in the report: expression for --solver} of what this program has, the default first."""
        known = {"latin": "latin"} if self.takes_solver else {"latin": None}
        if self.takes_solver and "`massless_contact`" in self.schema:
            known["latin implicit"] = 'latin{ integration = "implicit" }'
            known["latin implicit tuned"] = 'latin{ integration = "implicit", mass = "tuned", massless_contact = true }'
            known["latin explicit lumped"] = 'latin{ integration = "explicit", mass = "lumped" }'
            known["latin explicit tuned"] = 'latin{ integration = "explicit", mass = "tuned" }'
        if self.has_solver("monolithic"):
            known["monolithic"] = "monolithic"
        if self.has_solver("explicit"):
            # The default penalty of 0.1 lets these scenes' sides overlap by several cells: a fair rival takes 1.
            known["explicit one_point"] = "explicit{ penalty = 1 }"
            known["explicit full"] = 'explicit{ penalty = 1, integration = "full" }'
        return known

    def run(self, deck, settings=None, solver=None, threads=1, limit=900):
        """Computes `deck` (relative to the repository) with parameters `settings`; never raises on an exit code."""
        self.count += 1
        out = self.scratch / f"run_{self.count}"
        command = [self.path, "run", self.root / deck, "--quiet", "--threads", threads, "--out", out, "--time-limit", limit]
        for name, value in (settings or {}).items():
            command += ["--set", f"{name}={value}"]
        if solver:
            command += ["--solver", solver]
        if self.takes_no_frames:
            command.append("--no-frames")
        environment = dict(os.environ, OPENBLAS_NUM_THREADS="1")
        began, used = time.monotonic(), processor_seconds()
        try:
            done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=limit, env=environment)
            code, text = done.returncode, done.stdout + done.stderr
        except subprocess.TimeoutExpired as stopped:
            code, text = None, (stopped.stdout or b"").decode()
        records = sorted(out.glob("*/*/run.json"), key=lambda path: path.stat().st_mtime_ns)
        share = min(1.0, (processor_seconds() - used) / (time.monotonic() - began))
        return Run(code, text, {path.parent.name: path.parent for path in records}, share)

    def timed(self, deck, settings=None, solver=None, limit=900):
        """A run on one thread and its seconds of computation, the median of three where they are under one.

        They are processor time: elapsed seconds of run.json times the share of a processor that the run had.
        """
        run = self.run(deck, settings, solver, limit=limit)
        if not run.cases:
            return run, None
        times = [run.share * seconds(run.record())]
        while times[0] < 1 and len(times) < 3:
            again = self.run(deck, settings, solver)
            times.append(again.share * seconds(again.record()))
        return run, statistics.median(times)
