#!/usr/bin/python3
"""The verification report: runs the decks, draws the figures, writes verification.md. See ./run.sh help."""

import argparse
import platform
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import exact_pages  # noqa: E402
import page  # noqa: E402
from runs import Program  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=str(HERE.parents[1] / "build/release/dygita"), help="the program to run")
    parser.add_argument("--quick", action="store_true", help="fewer sizes and runs, three minutes")
    parser.add_argument("--only", metavar="CASE", help="one exact case, 'orders', 'hard' or a scene of speed: figures and CSV, no chapter")
    parser.add_argument("--into", metavar="DIR", default=str(HERE.parent), help="where verification.md and verification/ are written")
    return parser.parse_args()


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


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
        done = exact_pages.exact_cases(program, folder, say, asked.only)
        summary = [row for measured in done for row in exact_pages.summary_rows(measured)]
        orders_rows = None
        if asked.only in (None, "orders"):
            more, orders_rows = exact_pages.orders(program, folder, say)
            summary += more
        parts = [page.exact_section(done, orders_rows)]
    machine = f"Machine: {processor()}."
    chapter = "\n\n".join([page.opening(summary, machine, asked.quick), *parts]) + "\n"
    print(chapter)
    if not asked.only:
        (into / "verification.md").write_text(chapter)
    say(f"{program.count} runs")


if __name__ == "__main__":
    main()
