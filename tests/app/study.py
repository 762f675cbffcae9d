"""A study that is killed in one of its cases goes on with all that were still to come, to the same bits.

study.py PROGRAM FOLDER_OF_THE_DECK
"""

import csv
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM, DECK = sys.argv[1], pathlib.Path(sys.argv[2]) / "study.lua"
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_study_"))
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)


def dygita(*words, expected=0, says=""):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120, check=False)
    output = done.stdout + done.stderr
    check(done.returncode == expected and says in output,
          f"dygita {' '.join(map(str, words))}: exit {done.returncode}, expected {expected} and '{says}'\n{output}")
    return output


def contents(study):
    """Tables and frames of all cases; what tells of time is left out."""
    files = {p.relative_to(study): p.read_bytes() for p in study.rglob("*") if p.suffix in (".csv", ".vtu", ".pvd")}
    with open(study / "study.csv", newline="") as file:
        files[pathlib.Path("study.csv")] = [{k: v for k, v in row.items() if k != "seconds [s]"} for row in csv.DictReader(file)]
    return files


def killed_in(case, *more):
    """The study, killed when this case has written some frames."""
    out = FOLDER / f"killed in {case}{len(more)}"
    process = subprocess.Popen([PROGRAM, "run", str(DECK), "--quiet", "--threads", "1", "--out", str(out), *more],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    study = out / "study"
    while process.poll() is None and sum(1 for _ in (study / case).rglob("*.vtu")) < 6:
        time.sleep(0.001)
    process.send_signal(signal.SIGKILL)
    process.wait()
    check((study / case / "checkpoint.dygita").exists(), f"{case}: it was not killed in the middle")
    return study


whole = dygita("run", DECK, "--quiet", "--threads", 1, "--out", FOLDER / "whole")
expected = contents(FOLDER / "whole" / "study")
for case in ("mu 0.1", "mu 0.2", "mu 0.3"):
    study = killed_in(case)
    output = dygita("continue", study, "--quiet", "--threads", 1)
    found = contents(study)
    names = sorted(map(str, set(found) | set(expected)))
    different = [n for n in names if found.get(pathlib.Path(n)) != expected.get(pathlib.Path(n))]
    check(not different, f"killed in {case}, continued: {', '.join(different)} differ")
    printed = [line for line in whole.splitlines() if line.startswith("mu ")]
    check([line for line in output.splitlines() if line.startswith("mu ")] == printed, f"{case}: other lines are printed\n{output}")
dygita("continue", FOLDER / "whole" / "study", expected=2, says="every case that was begun in")

# What is to be left out is left out again; and what is continued further asks for a case of its own.
study = killed_in("mu 0.2", "--set", "us=2000")
case = study / "mu 0.2"
dygita("continue", study, "--tolerance", "1e-9", "--quiet", expected=2, says="the run is not complete")
dygita("continue", study, "--quiet", "--threads", 1)
dygita("continue", case, "--tolerance", "1e-8", "--quiet", "--threads", 1)
check(not list(study.rglob("checkpoint.dygita")), "a checkpoint is left")
shutil.rmtree(FOLDER)
print("\n".join(failures) or "a study that was killed goes on to its end")
sys.exit(1 if failures else 0)
