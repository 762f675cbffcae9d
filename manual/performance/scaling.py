"""Iterations and time against time step, number of pieces and size."""

import figures
from measure import write_rows
from page import table
from scene_runs import BLOCKS, FLANGES

BRICKS = {4: (2, 1, 2), 8: (2, 2, 2), 16: (4, 2, 2), 32: (4, 4, 2), 64: (4, 4, 4)}


IMPLICIT = 'latin{ integration = "implicit" }'     # explicit pieces are not iterated


def bricks(n):
    return dict(zip(("bx", "by", "bz"), BRICKS[n]))


def asked(machine, quick):
    """[(study, pieces, cfl, deck, settings, solver)]"""
    cells = 12 if quick else 20
    base = {"cells": cells, "steps": 20 if quick else 40}
    counts = (4, 8, 64) if quick else tuple(BRICKS)
    found = [("CFL", 8, cfl, BLOCKS, base | bricks(8) | {"cfl": cfl}, IMPLICIT) for cfl in ((1, 10) if quick else (0.5, 1, 2, 5, 10))]
    found += [("pieces", n, 1, BLOCKS, base | bricks(n), IMPLICIT) for n in counts]
    found += [("pieces, CFL 10", n, 10, BLOCKS, base | bricks(n) | {"cfl": 10}, IMPLICIT) for n in ((8, 64) if quick else counts)]
    found += [("static", n, 1, BLOCKS, base | bricks(n) | {"press": 1, "steps": 2}, IMPLICIT) for n in ((64,) if quick else (8, 64))]
    if machine.cuts:
        found += [("flanges, cut", n, "", FLANGES, {"size": "3*mm" if quick else "1.4*mm", "duration": "50*us"}, f'latin{{ integration = "implicit", pieces = {n} }}')
                  for n in ((8,) if quick else (8, 16, 32, 64))]
    return found


def measure(machine, folder, quick):
    """Writes scaling.csv: one row per run, on all threads."""
    rows = []
    for study, pieces, cfl, deck, settings, solver in asked(machine, quick):
        machine.say(f"Scaling: {study}, {pieces} pieces, CFL {cfl}")
        run = machine.deck(deck, settings, solver, machine.threads[-1])
        static = [step for step in run.record["steps"] if step["kind"] == "static"]
        shock = run.shock
        rows.append({"study": study, "pieces": pieces, "cfl": cfl, "dofs": run.dofs, "steps": shock["increments"],
                     "iterations per step": shock["iterations"] / shock["increments"], "ms per step": 1e3 * shock["seconds"] / shock["increments"],
                     "static iterations": sum(s["iterations"] for s in static) / max(1, sum(s["increments"] for s in static)),
                     "not converged": sum(s["increments_not_converged"] for s in run.record["steps"]),
                     "factors [MB]": run.record["figures"]["memory of factors and interface operators [MB]"], "share of the processor": run.share})
    write_rows(folder / "scaling.csv", rows)


def of(rows, study):
    return [r for r in rows if r["study"] == study]


def goals(rows):
    done = []
    for limit, cfls in ((5, (1, 2)), (10, (10,))):
        mine = [r for r in of(rows, "CFL") if r["cfl"] in cfls]
        worst = max(r["iterations per step"] for r in mine)
        done.append((f"iterations per step at CFL {' and '.join(str(c) for c in cfls if any(r['cfl'] == c for r in mine))}, tolerance 1e-6, 8 pieces: at most {limit}",
                     f"{worst:.1f}", worst <= limit, "search directions that are diagonal, a number for each unknown"))
    counts = [r["iterations per step"] for r in of(rows, "pieces")]
    growth = max(counts) / min(counts)
    done.append(("iterations from 4 to 64 pieces, CFL 1: within 20 %", f"{100 * (growth - 1):.0f} %", growth <= 1.2, "pieces that touch more others"))
    static = max(r["static iterations"] for r in of(rows, "static") if r["pieces"] == 64)
    done.append(("iterations of a static step of 64 pieces: at most 20", f"{static:.0f}", static <= 20,
                 "friction: two pieces need nearly as many; tied throughout, 64 pieces need 16 (manual, static steps)"))
    return done


def figure(rows, folder):
    picture, axes = figures.plt.subplots(1, 2, figsize=(7.4, 2.8))
    picture.subplots_adjust(wspace=0.3)
    mine = of(rows, "CFL")
    axes[0].semilogx([r["cfl"] for r in mine], [r["iterations per step"] for r in mine], marker="o", color=figures.COMPUTED)
    axes[0].set_title("iterations per step, 8 pieces")
    axes[0].set_xlabel("CFL")
    figures.sized_ticks(axes[0], [r["cfl"] for r in mine], [f"{r['cfl']:g}" for r in mine], "CFL")
    for i, study in enumerate(("pieces", "pieces, CFL 10")):
        mine = of(rows, study)
        axes[1].semilogx([r["pieces"] for r in mine], [r["iterations per step"] for r in mine], marker=figures.MARKERS[i], color=figures.COLOURS[i],
                         label="CFL 10" if i else "CFL 1")
    figures.sized_ticks(axes[1], [r["pieces"] for r in of(rows, "pieces")], [f"{r['pieces']:g}" for r in of(rows, "pieces")], "pieces")
    axes[1].set_title("iterations per step")
    axes[1].legend()
    for a in axes:
        a.set_ylim(0)
    figures.save(picture, folder / "scaling.svg")


def section(rows):
    def shown(value):
        return f"{value:g}" if isinstance(value, float) else value
    cells = [(r["study"], shown(r["pieces"]), shown(r["cfl"]), f"{r['dofs']:.0f}", f"{r['iterations per step']:.1f}", f"{r['ms per step']:.1f}",
              f"{r['static iterations']:.0f}" if r["static iterations"] else "", f"{r['factors [MB]']:.0f}") for r in rows]
    failed = [f"{r['study']}, {shown(r['pieces'])} pieces, CFL {shown(r['cfl'])}: {r['not converged']:.0f} steps" for r in rows if r["not converged"]]
    return "\n\n".join(filter(None, [
        "## Scaling", f"`{BLOCKS}`, tolerance 1e-6, all threads." + (f" *Flanges, cut*: `{FLANGES}` with solver.latin{{ pieces = n }}." if of(rows, "flanges, cut") else ""),
        "![Iterations against CFL and pieces](performance/scaling.svg)",
        table(["study", "pieces", "CFL", "unknowns", "iterations per step", "ms per step", "iterations of a static step", "factors MB"], cells),
        failed and "Not converged: " + "; ".join(failed) + "."]))
