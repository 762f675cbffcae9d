"""dygita under mpirun: every table and every frame has the bits of one process; errors are said once; what ranks cannot share is refused.

ranks.py PROGRAM MPIRUN FOLDER_OF_THE_DECKS [--ranks N]
"""

import argparse
import hashlib
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

asked = argparse.ArgumentParser()
asked.add_argument("program")
asked.add_argument("mpirun")
asked.add_argument("folder", type=pathlib.Path)
asked.add_argument("--ranks", type=int, nargs="*", default=[2])
asked = asked.parse_args()
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_ranks_"))
failures = []


def dygita(ranks, *words, expected, says=(), never=()):
    start = [asked.mpirun, "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    done = subprocess.run([*start, asked.program, *map(str, words)], capture_output=True, text=True, timeout=280, check=False, env=environment)
    said = done.stdout + done.stderr
    wrong = [text for text in says if said.count(text) != 1] + [f"not: {text}" for text in never if text in said]
    if done.returncode != expected or wrong:
        failures.append(f"{ranks} ranks: dygita {' '.join(map(str, words))}: exit {done.returncode}, expected {expected}; {wrong}\n{said}")
    return said


def contents(run):
    # The state has seconds in its header, records and pages tell times.
    told_apart = {"run.json", "report.html", "state.dygita", "view.py"}
    return {str(p.relative_to(run)): hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(run.rglob("*"))
            if p.is_file() and p.name not in told_apart}


def compare(name, deck, problem, *words, cases=("base",), most=1000, also=()):
    runs = {}
    several = sorted({*(ranks for ranks in asked.ranks if ranks <= most), *also})
    for ranks in [1, *several]:
        out = FOLDER / f"{name}_{ranks}"
        dygita(ranks, "run", deck, "--quiet", "--threads", 1, "--out", out, *words, expected=0)
        runs[ranks] = [contents(out / problem / case) for case in cases]
    for ranks in several:
        for alone, shared in zip(runs[1], runs[ranks]):
            if len(alone) < 3:
                failures.append(f"{name}: one process has written {sorted(alone)} only")
            differ = [file for file in {**alone, **shared} if alone.get(file) != shared.get(file)]
            if differ:
                failures.append(f"{name}: {ranks} ranks give other bits than one process: {sorted(differ)}")


stopped = asked.folder / "stopped.lua"
compare("implicit", stopped, "stopped")
compare("windows", stopped, "stopped", "--set", "window=4")
compare("explicit", stopped, "stopped", "--set", "explicit=1")
compare("all_explicit", stopped, "stopped", "--solver", "latin{ integration = 'explicit' }")
compare("passes", stopped, "stopped", "--set", "passes=1")
unlike = asked.folder / "ranks_unlike.lua"
compare("unlike", unlike, "unlike", most=4, also=[2, 3])
compare("damped", unlike, "unlike", "--set", "beta=2e-8", "--set", "driven=1", most=4, also=[2, 3])
compare("tuned", unlike, "unlike", "--set", "beta=1e-8", "--set", "tuned=1", most=4)
compare("pieces", asked.folder / "ranks.lua", "ranks")
compare("study", asked.folder / "study.lua", "study", cases=("mu 0.1", "mu 0.2", "mu 0.3"), most=2)


def ranks_of(pid):
    """Processes that mpirun has started, in their order."""
    listed = subprocess.run(["ps", "-o", "pid=,stat=", "--ppid", str(pid)], capture_output=True, text=True, check=False).stdout.split("\n")
    return sorted(int(line.split()[0]) for line in listed if line and not line.split()[1].startswith("Z"))


def kill_one():
    """A rank that dies ends the run; one process goes on with what was computed, to the bits of a run that was never stopped."""
    words = ["run", stopped, "--set", "us=3000", "--no-frames", "--quiet", "--threads", "1", "--out"]
    dygita(1, *words, FOLDER / "whole", expected=0)
    out = FOLDER / "killed"
    process = subprocess.Popen([asked.mpirun, "--allow-run-as-root", "--oversubscribe", "-n", "2", asked.program, *map(str, [*words, out])],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    run = out / "stopped" / "base"
    begun = time.monotonic()
    while not ((run / "checkpoint.dygita").exists() and (run / "checkpoint.dygita").stat().st_size > 200000):
        if process.poll() is not None or time.monotonic() > begun + 100:
            failures.append("the run under mpirun has left no checkpoint to kill it by")
            process.kill()
            return
        time.sleep(0.01)
    os.kill(ranks_of(process.pid)[-1], signal.SIGKILL)
    said = process.communicate(timeout=100)[1]
    if process.returncode == 0 or "signal 9" not in said:
        failures.append(f"a rank was killed: mpirun exits with {process.returncode}\n{said}")
    dygita(1, "continue", run, "--no-frames", "--quiet", "--threads", "1", expected=0)
    alone, continued = contents(FOLDER / "whole" / "stopped" / "base"), contents(run)
    differ = [file for file in {**alone, **continued} if alone.get(file) != continued.get(file)]
    if differ:
        failures.append(f"a rank was killed, and one process goes on to other bits: {sorted(differ)}")


kill_one()
dygita(7, "run", stopped, "--quiet", "--out", FOLDER / "many", expected=2, says=["7 MPI ranks for 6 substructures"])
dygita(2, "run", stopped, "--quiet", "--solver", "monolithic", "--out", FOLDER / "one", expected=2, says=["solver.monolithic is one system"])
dygita(2, "run", stopped, "--quiet", "--solver", "latin{ static_steps = 'assembled' }", "--out", FOLDER / "one", expected=2,
       says=["is one system of all substructures"])
dygita(2, "check", stopped, expected=2, says=["dygita check: not on several MPI ranks"])
dygita(2, "run", stopped, "--set", "usage=1", "--quiet", "--out", FOLDER / "none", expected=2, says=["usage"])
dygita(2, "run", FOLDER / "none.lua", expected=2, says=["no deck"])
# A history that fails in the middle of a run fails on all ranks, and is told once.
dygita(2, "run", stopped, "--set", "broken=1", "--quiet", "--out", FOLDER / "broken", expected=2, says=["no record at 20 us"])
shutil.rmtree(FOLDER)
print("\n".join(failures) or "the same bits on several ranks")
sys.exit(1 if failures else 0)
