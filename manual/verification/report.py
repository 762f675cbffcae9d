#!/usr/bin/python3
"""The verification report: runs the decks, draws the figures, writes verification.md. See ./run.sh help."""

import argparse
import os
import platform
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import effectivity  # noqa: E402
import exact_pages  # noqa: E402
import figures  # noqa: E402
import hard  # noqa: E402
import page  # noqa: E402
import speed  # noqa: E402
from runs import Program  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=str(HERE.parents[1] / "build/release/dygita"), help="the program to run")
    parser.add_argument("--quick", action="store_true", help="fewer sizes and runs, three minutes")
    parser.add_argument("--only", metavar="CASE", 
                        help="an exact case by name, orders, hard, speed, speed_<scene> or estimates: its figures and CSV, no chapter")
    parser.add_argument("--effectivity", default=str(HERE.parents[1] / "build/release/tests/effectivity"),
                        help="the program that compares error estimates with true errors")
    parser.add_argument("--keep-speed", action="store_true", help="take the runs of speed from speed.csv; the chapter says so")
    parser.add_argument("--into", metavar="DIR", default=str(HERE.parent), help="where verification.md and verification/ are written")
    return parser.parse_args()


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def exact_parts(asked, program, folder, say):
    """Rows of the summary and the section of the exact cases."""
    done = exact_pages.exact_cases(program, folder, say, asked.only)
    summary = [row for measured in done for row in exact_pages.summary_rows(measured)]
    orders_rows = None
    if asked.only in (None, "orders"):
        more, orders_rows = exact_pages.orders(program, folder, say)
        summary += more
    return summary, page.exact_section(done, orders_rows)


def other_parts(asked, program, folder, say):
    """The sections on hard cases, speed and estimates, those that are asked for."""
    parts = []
    if asked.only in (None, "hard"):
        say("Hard cases")
        outcomes = hard.hard_cases(program, say, asked.quick)
        hard.write_csv(folder / "hard.csv", outcomes)
        figures.save(hard.figure(outcomes), folder / "hard.svg")
        parts.append(page.hard_section(outcomes))
    if asked.only is None or asked.only.startswith("speed"):
        say("Speed against error: one run at a time, on one thread")
        parts.append(page.speed_section(speed.scenes(program, folder, say, asked.quick, (asked.only or "speed")[len("speed_"):] or None,
                                                    asked.keep_speed), asked.keep_speed))
    if asked.only in (None, "estimates"):
        say("Error estimates")
        rows = None if asked.quick and not asked.only else effectivity.run(asked.effectivity, folder, say)
        if rows:
            figures.save(effectivity.figure(rows), folder / "effectivity.svg")
        parts.append(page.estimates_section(rows))
    return parts


def main():
    asked, began = arguments(), time.monotonic()
    into = Path(asked.into)
    folder = into / "verification"
    folder.mkdir(parents=True, exist_ok=True)

    def say(text):
        print(f"[{time.monotonic() - began:5.0f} s] {text}", flush=True)

    with tempfile.TemporaryDirectory() as scratch:
        program = Program(asked.program, HERE.parents[1], scratch)
        say("Exact cases")
        summary, exact = exact_parts(asked, program, folder, say)
        parts = [exact, *other_parts(asked, program, folder, say)]
    minutes = (time.monotonic() - began) / 60
    machine = f"Machine: {processor()}, {os.cpu_count()} cores; {program.count} runs in {minutes:.0f} minutes."
    chapter = "\n\n".join([page.opening(summary, machine, asked.quick), *parts]) + "\n"
    print(chapter)
    if not asked.only:
        (into / "verification.md").write_text(chapter)
        say(f"Written: {into / 'verification.md'} and {folder}/")


if __name__ == "__main__":
    main()
