"""Iterations per step of decks/verification/iterations.lua and of bench/even_flanges.lua, as the tables of the manual.

python3 manual/verification/iterations.py build/dygita [--flanges]        about ten seconds; the flanges at 2 and 1.5 mm take a minute
"""

import argparse
import json
import os
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BRICKS = {2: (1, 1, 2), 4: (1, 2, 2), 8: (2, 2, 2), 16: (2, 2, 4), 64: (4, 4, 4)}


def iterations(program, deck, settings, solver=None):
    """Mean iterations of each step, as text; increments that did not converge are told after an exclamation mark."""
    with tempfile.TemporaryDirectory() as out:
        command = [program, "run", ROOT / "decks" / deck, "--quiet", "--no-frames", "--threads", "1", "--out", out]
        for name, value in settings.items():
            command += ["--set", f"{name}={value}"]
        if solver:
            command += ["--solver", solver]
        environment = dict(os.environ, OPENBLAS_NUM_THREADS="1")
        subprocess.run([str(c) for c in command], env=environment, capture_output=True)
        record = json.loads(next(Path(out).glob("*/*/run.json")).read_text())
    told = []
    for step in record["steps"]:
        missed = step["increments_not_converged"]
        told.append(f"{step['iterations'] / step['increments']:.1f}" + (f"!{missed}" if missed else ""))
    return ", ".join(told)


def block(program, n, solver="", **settings):
    return iterations(program, "verification/iterations.lua", dict(zip(("nx", "ny", "nz"), BRICKS[n]), **settings), implicit(solver))


def implicit(more=""):
    """Explicit substructures are not iterated."""
    return f'latin{{ integration = "implicit", {more} }}'


def print_table(head, rows):
    print("| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--flanges", action="store_true", help="the flanges at 2 and 1.5 mm too")
    arguments = parser.parse_args()
    program = arguments.program

    pieces = (2, 4, 8, 16, 64)
    rows = [[f"CFL {cfl}"] + [block(program, n, cfl=cfl) for n in pieces] for cfl in (1, 2, 5, 10)]
    rows += [["static: pressed, sheared"] + [block(program, n, static=1) for n in pieces]]
    rows += [["static, tied throughout"] + [block(program, n, static=1, tie=1) for n in pieces]]
    print_table(["pieces"] + [str(n) for n in pieces], rows)

    ratios = ("50", "0.02")
    print_table(["8 pieces, upper half stiffer by"] + list(ratios),
                [[f"CFL {cfl}"] + [block(program, 8, cfl=cfl, ratio=r) for r in ratios] for cfl in (1, 5)] +
                [["static: pressed, sheared"] + [block(program, 8, static=1, ratio=r) for r in ratios]])

    depths = ("0", "5", "10", "20")
    print_table(["8 pieces, `anderson`"] + list(depths),
                [[f"CFL {cfl}"] + [block(program, 8, f"anderson = {m}", cfl=cfl) for m in depths] for cfl in (1, 5, 10)])

    masses = ("lumped", "tuned")
    print_table(["`crush.lua`, mass"] + list(masses), [["shot"] + [iterations(program, "crush.lua", {}, implicit(f'mass = "{m}"')) for m in masses]])

    pads = ("6*MPa", "0.5*GPa", "20*GPa", "200*GPa")
    facets = {"8, 3.7, 5 mm": {}, "3, 6, 3 mm": {"lower": "3*mm", "middle": "6*mm", "upper": "3*mm"}}
    print_table(["`bonded_stack.lua`, facets"] + list(pads),
                [[name] + [iterations(program, "verification/bonded_stack.lua", {"young": e, **of}, implicit()) for e in pads] for name, of in facets.items()])

    sizes = ("4*mm", "2*mm", "1.5*mm") if arguments.flanges else ("4*mm",)
    print_table(["bolted flanges"] + list(sizes), [["tighten, shock"] + [iterations(program, "bench/even_flanges.lua", {"size": s}, implicit()) for s in sizes]])


if __name__ == "__main__":
    main()
