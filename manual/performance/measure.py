"""Runs the program and the benchmark programs on this machine and reads back what they measured."""

import concurrent.futures
import csv
import io
import itertools
import json
import os
import platform
import statistics
import subprocess
import threading
import time
from dataclasses import dataclass
from pathlib import Path

PHASES = ["assemble", "factor", "forward", "interface operator", "local stage", "acceleration", "backward", "laws and energies", "output"]


@dataclass
class DeckRun:
    """One run of a deck: its run.json, the folder of its tables, its peak memory, and how much of its threads it had."""

    record: dict
    folder: Path
    peak_bytes: int
    share: float        # processor time over elapsed time and threads: well under 1 on one thread, the machine was busy
    processor: float = 0.0    # seconds

    @property
    def shock(self):
        """The last step of run.json, the shock."""
        return self.record["steps"][-1]

    @property
    def dofs(self):
        return self.record["size"]["dofs"]

    def per_step(self, phase):
        """Seconds of a phase over all increments of the run, static ones included."""
        return self.record["seconds"].get(phase, 0.0) / sum(step["increments"] for step in self.record["steps"])


class Machine:
    """The programs of a build folder, run one at a time from the repository's root."""

    def __init__(self, build, root, scratch, say, most_unknowns=float("inf")):
        self.build, self.root, self.scratch, self.say = Path(build), Path(root), Path(scratch), say
        self.most_unknowns = most_unknowns    # of scenes
        self.threads = [1, 2] if (os.cpu_count() or 1) > 1 else [1]
        self.numbers = itertools.count(1)    # of runs, which may be side by side
        schema = subprocess.run([self.build / "dygita", "schema"], capture_output=True, text=True, check=True).stdout
        latin = schema[schema.index("`solver.latin{"):]
        self.cuts = "| `pieces` " in latin[:latin.index("\n### ")]      # solver.latin cuts substructures itself

    def environment(self):
        return dict(os.environ, OPENBLAS_NUM_THREADS="1")

    def run(self, command, limit):
        """Standard output, peak memory (bytes) and processor seconds of a program; RuntimeError where it fails or takes too long."""
        process = subprocess.Popen([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=self.root,
                                   env=self.environment())
        complaints = []
        reader = threading.Thread(target=lambda: complaints.append(process.stderr.read()))
        stopper = threading.Timer(limit, process.kill)
        reader.start()
        stopper.start()
        text = process.stdout.read().decode()
        _, status, used = os.wait4(process.pid, 0)
        stopper.cancel()
        reader.join()
        process.returncode = os.waitstatus_to_exitcode(status)
        process.stdout.close()
        process.stderr.close()
        if process.returncode not in (0, 1):
            raise RuntimeError(f"{' '.join(map(str, command))}\nended with {process.returncode} (limit {limit} s)\n{complaints[0].decode()[-2000:]}")
        return text, 1024 * used.ru_maxrss, used.ru_utime + used.ru_stime

    def deck(self, deck, settings=None, solver=None, threads=1, limit=600):
        """Computes a deck with parameters `settings`, no frames written."""
        out = self.scratch / f"run_{next(self.numbers)}"
        command = [self.build / "dygita", "run", self.root / deck, "--quiet", "--no-frames", "--threads", threads, "--out", out]
        for name, value in (settings or {}).items():
            command += ["--set", f"{name}={value}"]
        if solver:
            command += ["--solver", solver]
        began = time.monotonic()
        _, peak, used = self.run(command, limit)
        elapsed = time.monotonic() - began
        record = next(out.glob("*/*/run.json"))
        return DeckRun(json.loads(record.read_text()), record.parent, peak, used / elapsed / threads, used)

    def side_by_side(self, n, deck, settings=None, solver=None, limit=600, threads=1):
        """Seconds until n processes have all computed a deck; of one thread: what the machine has for n threads in these minutes."""
        with concurrent.futures.ThreadPoolExecutor(n) as pool:
            runs = [pool.submit(self.deck, deck, settings, solver, threads, limit) for _ in range(n)]
            return max(run.result().record["seconds"]["all"] for run in runs)

    def linear(self, deck, settings=None, threads=(1,), steps=0, limit=900):
        """Rows of bench_linear by (threads, form)."""
        command = [self.build / "tests/bench_linear", self.root / deck, "--threads", ",".join(map(str, threads)), "--steps", steps]
        command += [f"{name}={value}" for name, value in (settings or {}).items()]
        text, peak, _ = self.run(command, limit)
        rows = [{k: v if k == "form" else float(v) for k, v in row.items()} for row in csv.DictReader(io.StringIO(text))]
        return {(int(row["threads"]), row["form"]): dict(row, peak=peak) for row in rows}

    def kernels(self, pattern, min_time):
        """Google Benchmark's results by name."""
        out = self.scratch / f"kernels_{next(self.numbers)}.json"
        self.run([self.build / "tests/bench_kernels", f"--benchmark_filter={pattern}", f"--benchmark_min_time={min_time}",
                  f"--benchmark_out={out}", "--benchmark_out_format=json"], 900)
        return {b["name"].replace("/real_time", "").replace("/manual_time", "").replace("/iterations:1", ""): b
                for b in json.loads(out.read_text())["benchmarks"]}


def processor():
    """Name of the processor, its widest registers and how many cores there are, in a line."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        name = next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))
        flags = next((line for line in lines if line.startswith("flags")), "").split()
    except (OSError, StopIteration):
        name, flags = platform.processor() or platform.machine(), []
    widest = next((known for flag, known in (("avx512f", "AVX-512"), ("avx2", "AVX2")) if flag in flags), None)
    return f"{name}{f' ({widest})' if widest else ''}, {os.cpu_count()} cores"


def write_rows(path, rows):
    """A CSV of dictionaries with the same keys."""
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)


def read_rows(path):
    """What write_rows wrote, numbers as numbers."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(path, newline="") as file:
        return [{k: value(v) for k, v in row.items()} for row in csv.DictReader(file)]


median = statistics.median
