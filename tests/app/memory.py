"""What `dygita check` says of memory is within a factor of two of what a run takes at most.

memory.py PROGRAM DECKS
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

PROGRAM, DECKS = sys.argv[1], pathlib.Path(sys.argv[2])
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dygita_memory_"))
FLANGES = ["bench/even_flanges.lua", "--set", "size=2.12*mm", "--set", "duration=2*us", "--solver"]
SCENES = {
    "substructure by substructure": [*FLANGES, "latin{ integration = 'implicit' }"],
    "in one system": [*FLANGES, "latin{ static_steps = 'assembled', integration = 'implicit' }"],
    "electronics box": ["electronics_box.lua", "--set", "size=18*mm", "--set", "duration=0"],
}


def dygita(command, words):
    """What it prints, and the memory that it takes at most (bytes)."""
    log = FOLDER / "log"
    with log.open("w") as out:
        process = subprocess.Popen([PROGRAM, command, str(DECKS / words[0]), *words[1:], "--threads", "1"], stdout=out, stderr=out)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{command} {words}: exit {process.returncode}\n{log.read_text()}")
    return log.read_text(), 1024.0 * usage.ru_maxrss


failures = []
for name, words in SCENES.items():
    said = re.search(r"about ([\d.e+]+) MB of memory on one thread", dygita("check", words)[0])
    taken = 1e-6 * dygita("run", [*words, "--quiet", "--out", str(FOLDER / "out")])[1]
    print(f"{name}: {said and said[1]} MB said, {taken:.0f} MB taken")
    if not said or not 0.5 * taken < float(said[1]) < 2.0 * taken:
        failures.append(name)
sys.exit(f"not within a factor of two: {failures}" if failures else 0)
