#!/usr/bin/python3
"""The benchmarks: measures, draws the figures, writes performance.md. See ./run.sh help."""

import argparse
import json
import os
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "verification")]

import ensembles  # noqa: E402
import headline  # noqa: E402
import kernels  # noqa: E402
import ranks  # noqa: E402
import scaling  # noqa: E402
import scene_runs  # noqa: E402
import statics  # noqa: E402
from measure import Machine, processor, read_rows  # noqa: E402
from page import table  # noqa: E402

PARTS = {"headline": headline, "kernels": kernels, "scenes": scene_runs, "statics": statics, "scaling": scaling, "ensembles": ensembles, "ranks": ranks}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("parts", nargs="*", help=f"what to measure, of {' '.join(PARTS)}; all by default. The rest of the chapter keeps its figures")
    parser.add_argument("--build", default=str(HERE.parents[1] / "build/release"), help="folder of the programs")
    parser.add_argument("--quick", action="store_true", help="small sizes, single runs: whether everything works, some minutes")
    parser.add_argument("--up-to", metavar="UNKNOWNS", type=float, default=float("inf"), help="leave larger scenes out: for a machine that is lent for minutes")
    parser.add_argument("--page", action="store_true", help="measure nothing: write the page again from what was measured")
    parser.add_argument("--into", metavar="DIR", default=str(HERE.parent), help="where performance.md and performance/ are written")
    asked = parser.parse_args()
    for part in asked.parts:
        if part not in PARTS:
            parser.error(f"unknown part '{part}'; known: {' '.join(PARTS)}")
    return asked


def rows_of(part, folder):
    """What measure() of a part wrote, as the arguments of its goals, figure and section; None where it was never measured."""
    if not (folder / f"{part}.csv").exists():
        return None
    rows = read_rows(folder / f"{part}.csv")
    # Of a version that did not yet choose how to integrate: to be measured anew.
    return None if part == "headline" and "integration" not in rows[0] else rows


def section_of(part, folder, rows):
    module = PARTS[part]
    if hasattr(module, "figure"):
        module.figure(rows, folder)
    return headline.section(rows, read_rows(folder / "tolerance.csv")) if part == "headline" else module.section(rows)


def chapter(folder, measured):
    """The page from the CSVs of the folder; measured: {part: how it was measured}."""
    found = {part: rows for part in PARTS if (rows := rows_of(part, folder))}
    goals = [goal for part, rows in found.items() for goal in PARTS[part].goals(rows)]
    verdicts = {True: "met", False: "**MISSED**", None: "not measured"}
    counts = {words: sum(goal[2] is met for goal in goals) for met, words in ((True, "met"), (False, "missed"), (None, "not measured"))}
    lines = [(text, value, verdicts[met], "" if met else why) for text, value, met, why in goals]
    others = sorted((folder / "others").glob("*/measured.json"))
    told = [(part, how["machine"], how["date"], f"{how['minutes']:.1f}", "quick" if how["quick"] else "full") for part, how in measured.items() if part in found]
    return "\n\n".join([
        "# Performance", "Written by `./run.sh bench`; that command measured all numbers and figures below. They come from one machine, and a shared machine "
        "does not always give a program all of its processors. The two sides of a ratio ran one after the other in the same command; it holds for the processor named here.",
        table(["part", "machine", "date", "minutes", "version"], told),
        f"Of {len(goals)} goals {', '.join(f'{n} {words}' for words, n in counts.items() if n)}. Goals come from the project's design.",
        table(["goal", "measured", "", "what bounds it"], lines), *(section_of(part, folder, rows) for part, rows in found.items()),
        *(["## On other processors", "The same parts of the bench (`--up-to`, `--into`), with fewer repetitions since these machines were lent for minutes; their tables lie beside these (`performance/others/`)."] if others else []),
        *(other(record, verdicts) for record in others)]) + "\n"


def other(record, verdicts):
    """The goals on another machine, from the CSVs beside its measured.json; those that were not measured there are left out."""
    measured = json.loads(record.read_text())
    found = {part: rows for part in PARTS if part in measured and (rows := rows_of(part, record.parent))}
    goals = [(text, value, verdicts[met]) for part, rows in found.items() for text, value, met, _ in PARTS[part].goals(rows) if met is not None]
    machines = sorted({measured[part]["machine"] for part in found})
    dates = sorted({measured[part]["date"] for part in found})
    gains = ", ".join(f"{scene} {dofs / 1e3:.0f}k {threads:.2f} ({processes:.2f})" for scene, dofs, threads, processes in scene_runs.speed_up(found.get("scenes", [])))
    return "\n\n".join([f"**{', '.join(machines)}**, {' to '.join(dates[:1] + dates[1:][-1:])}:", table(["goal", "measured", ""], goals),
                        *([f"Two threads over one there, and what two processes got done: {gains}."] if gains else [])])


def main():
    asked, began = arguments(), time.monotonic()
    into = Path(asked.into)
    folder = into / "performance"
    folder.mkdir(parents=True, exist_ok=True)

    def say(text):
        print(f"[{time.monotonic() - began:5.0f} s] {text}", flush=True)

    record = folder / "measured.json"
    measured = json.loads(record.read_text()) if record.exists() else {}
    for part in [] if asked.page else asked.parts or PARTS:
        with tempfile.TemporaryDirectory() as scratch:
            start = time.monotonic()
            PARTS[part].measure(Machine(asked.build, HERE.parents[1], Path(scratch), say, asked.up_to), folder, asked.quick)
            measured[part] = {"machine": processor(), "date": time.strftime("%Y-%m-%d"), "minutes": round((time.monotonic() - start) / 60, 1),
                              "quick": asked.quick, "threads": os.cpu_count()}
        record.write_text(json.dumps(measured, indent=1) + "\n")
    text = chapter(folder, measured)
    (into / "performance.md").write_text(text)
    print(text)
    say(f"Written: {into / 'performance.md'} and {folder}/")


if __name__ == "__main__":
    main()
