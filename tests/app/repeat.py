"""dygita run --repeat: the same bits from the record alone, with another number of threads; and what it refuses.

repeat.py PROGRAM FOLDER_OF_THE_DECK
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2]) / "stopped.lua"
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_repeat_"))
failures = []


def dygita(*words, expected, says=""):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120, check=False)
    if done.returncode != expected or says not in done.stdout + done.stderr:
        failures.append(f"dygita {' '.join(map(str, words))}: exit {done.returncode}, expected {expected} and '{says}'\n"
                        f"{done.stdout}{done.stderr}")


deck = FOLDER / "deck.lua"
shutil.copy(SOURCE, deck)
run = FOLDER / "first" / "stopped" / "base"
dygita("run", deck, "--set", "us=40", "--solver", "latin{ integration = 'implicit', tolerance = 1e-5 }", "--threads", 1, "--quiet", "--out", FOLDER / "first",
       expected=0)
for threads in (1, 2, 3):
    dygita("run", "--repeat", run / "run.json", "--threads", threads, "--quiet", "--out", FOLDER / f"again_{threads}", expected=0,
           says="deck, parameters, meshes and all 8 tables are identical, bit for bit")
table = run / "joint.csv"
whole = table.read_text()
table.write_text(whole.replace("1", "2", 1))
dygita("run", "--repeat", run, "--quiet", "--out", FOLDER / "other", expected=1, says="may have changed): joint.csv")
dygita("run", expected=2, says="which deck?")
shutil.copy(run / "run.json", FOLDER / "copy.json")
dygita("run", "--repeat", FOLDER / "copy.json", expected=2, says="give a run's folder or its run.json")
dygita("run", "--repeat", FOLDER / "none.json", expected=2, says="no such record")
dygita("run", "--repeat", run, "--set", "us=20", expected=2, says="--set")
moved = FOLDER / "moved.lua"
deck.rename(moved)
dygita("run", "--repeat", run, expected=2, says="is missing")
table.unlink()
dygita("run", moved, "--repeat", run, "--quiet", "--out", FOLDER / "lost", expected=2, says="its table 'joint.csv' is not there: nothing to compare with")
os.mkfifo(table)
dygita("run", moved, "--repeat", run, "--quiet", "--out", FOLDER / "lost", expected=2, says="its table 'joint.csv' is not a file: nothing to compare with")
table.unlink()
table.write_text(whole)
dygita("run", moved, "--repeat", run, "--quiet", "--out", FOLDER / "moved", expected=0, says="repeated:")
moved.write_text(moved.read_text() + "\n-- another\n")
dygita("run", moved, "--repeat", run, "--quiet", "--out", FOLDER / "changed", expected=2, says="has changed since the run")
# What the run was told to leave out is left out again, also where it is killed and goes on.
bare = FOLDER / "bare" / "stopped" / "base"
dygita("run", moved, "--set", "us=40", "--no-frames", "--no-state", "--quiet", "--out", FOLDER / "bare", expected=0)
dygita("run", "--repeat", bare, "--quiet", "--out", FOLDER / "bare again", expected=0, says="repeated:")
names = [sorted(str(p.relative_to(run)) for p in run.rglob("*")) for run in (bare, FOLDER / "bare again" / "stopped" / "base")]
if names[0] != names[1] or any("vtu" in name or "state" in name for name in names[1]):
    failures.append(f"--no-frames --no-state, repeated: {names}")
process = subprocess.Popen([PROGRAM, "run", str(moved), "--set", "us=3000", "--no-frames", "--quiet", "--out", str(FOLDER / "killed")])
killed = FOLDER / "killed" / "stopped" / "base"
while process.poll() is None and not ((killed / "checkpoint.dygita").exists() and (killed / "checkpoint.dygita").stat().st_size > 100000):
    time.sleep(0.01)
process.kill()
process.wait()
dygita("continue", killed, "--quiet", expected=0)
if list(killed.rglob("*.vtu")) or not (killed / "joint.csv").exists():
    failures.append("a run without frames was killed and has gone on with frames")
shutil.rmtree(FOLDER)
print("\n".join(failures) or "the same bits, and nothing else passes for them")
sys.exit(1 if failures else 0)
