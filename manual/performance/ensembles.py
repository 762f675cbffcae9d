#!/usr/bin/env python3
"""What an ensemble costs in runs of one member: processor time of all members over that of the median unit alone.

    manual/performance/ensembles.py build/release/dygita [--members 16] [--set size=7*mm ...]

Runs decks/flanges_ensemble.lua on one thread, and writes ensembles.csv beside this file.
"""
import argparse
import csv
import pathlib
import resource
import subprocess
import tempfile

here = pathlib.Path(__file__).resolve().parent
deck = here.parent.parent / "decks" / "flanges_ensemble.lua"


def seconds(program, settings):
    """Processor time (s) of a run, that of the mesher included, and the program's text."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory() as out:
        command = [program, "run", str(deck), "--threads", "1", "--quiet", "--out", out]
        for setting in settings:
            command += ["--set", setting]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--members", type=int, nargs="+", default=[4, 16])
    parser.add_argument("--set", dest="settings", action="append", default=[])
    given = parser.parse_args()
    one, _ = seconds(given.program, given.settings + ["alone=1"])
    print(f"one unit alone: {one:.1f} s of a processor")
    rows = [[1, f"{one:.2f}", "1.0"]]
    for n in given.members:
        all_members, _ = seconds(given.program, given.settings + [f"n={n}"])
        rows.append([n, f"{all_members:.2f}", f"{all_members / one:.1f}"])
        print(f"{n} members: {all_members:.1f} s, {all_members / one:.1f} runs")
    with open(here / "ensembles.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["members", "seconds", "runs"])
        writer.writerows(rows)


if __name__ == "__main__":
    main()
