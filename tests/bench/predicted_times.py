"""What `dygita check` says of time, beside the processor time that a run takes on one thread.

predicted_times.py PROGRAM DECKS [NAME ...]

A run reads the deck, meshes and finds contacts as a check does: that is taken off. Prints a table; no verdict.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

PROGRAM, DECKS, ONLY = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_times_"))
FLANGES = ["bench/even_flanges.lua", "--set", "size=3*mm", "--set", "duration=100*us", "--solver"]
SCENES = {
    "bolted flanges": ["bolted_flanges.lua"],
    "flanges, explicit": [*FLANGES, "latin{}"],
    "flanges, implicit": [*FLANGES, "latin{ integration = 'implicit' }"],
    "electronics box": ["electronics_box.lua", "--set", "size=18*mm", "--set", "duration=0.5*ms"],
    "separation ring": ["separation_ring.lua"],
    "instrument unit, static": ["instrument_unit.lua", "--set", "order=1", "--set", "duration=0"],
}
UNITS = {"s": 1.0, "min": 60.0, "h": 3600.0}


def dygita(command, words):
    """What it prints, and the processor time that it takes (s)."""
    log = FOLDER / "log"
    with log.open("w") as out:
        process = subprocess.Popen([PROGRAM, command, str(DECKS / words[0]), *words[1:], "--threads", "1"], stdout=out, stderr=out)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{command} {words}: exit {process.returncode}\n{log.read_text()}")
    return log.read_text(), usage.ru_utime + usage.ru_stime


print(f"{'scene':26} {'said [s]':>16} {'taken [s]':>10}  taken over the middle of what was said")
for name, words in SCENES.items():
    if ONLY and name not in ONLY:
        continue
    text, before = dygita("check", words)
    said = re.search(r"^  about (?:([\d.e+-]+) to )?([\d.e+-]+) (s|min|h) on 1 thread", text, re.M)
    most = float(said[2]) * UNITS[said[3]]
    least = float(said[1]) * UNITS[said[3]] if said[1] else most
    taken = dygita("run", [*words, "--quiet", "--no-frames", "--out", str(FOLDER / "out")])[1] - before
    print(f"{name:26} {f'{least:.3g} to {most:.3g}':>16} {taken:10.3g}  {taken / (least * most) ** 0.5:.2f}", flush=True)
