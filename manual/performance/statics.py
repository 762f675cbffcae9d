"""Static steps with all parts in one system: iterations, processor time of the whole run and peak memory, one thread."""

from measure import write_rows
from page import table

ONE_SYSTEM = 'latin{ static_steps = "assembled" }'
BOX = "electronics box, 12 mm, four bolts"
BOX_SECONDS = 10


def asked(quick):
    """[(scene, deck, settings, solver)]"""
    scenes = [("bolted flanges, in one system", "decks/bench/even_flanges.lua", {"duration": "1*us"}, ONE_SYSTEM)]
    if not quick:
        scenes.append((BOX, "decks/electronics_box.lua", {"size": "12*mm", "duration": 0}, None))
    return scenes


def measure(machine, folder, quick):
    """Writes statics.csv: one row per scene."""
    rows = []
    for scene, deck, settings, solver in asked(quick):
        machine.say(f"Static steps: {scene}")
        run = machine.deck(deck, settings, solver, 1, 1800)
        steps = [step for step in run.record["steps"] if step["kind"] == "static"]
        rows.append({"scene": scene, "dofs": run.dofs, "iterations": " ".join(f"{step['iterations'] / step['increments']:.3g}" for step in steps),
                     "not converged": sum(step["increments_not_converged"] for step in steps), "processor [s]": run.processor,
                     "factors [MB]": run.record["figures"]["memory of factors and interface operators [MB]"], "peak [MB]": run.peak_bytes / 1e6})
    write_rows(folder / "statics.csv", rows)


def goals(rows):
    return [(f"tightening of an {BOX}: under {BOX_SECONDS} s of processor time in all", f"{row['processor [s]']:.0f} s", row["processor [s]"] < BOX_SECONDS and row["not converged"] == 0,
             "an iteration of Newton's method costs a factor, or tens of products beside one") for row in rows if row["scene"] == BOX]


def section(rows):
    cells = [(r["scene"], f"{r['dofs']:.0f}", str(r["iterations"]).replace(" ", ", "), f"{r['not converged']:.0f}",
              f"{r['processor [s]']:.1f}", f"{r['factors [MB]']:.0f}", f"{r['peak [MB]']:.0f}") for r in rows]
    return "\n\n".join([
        "## Static steps in one system", "Tightening with friction, all parts in one system (`static_steps = \"assembled\"`), to the usual tolerance of 1e-8; processor time is that of the whole run, mesh and results included.",
        table(["scene", "unknowns", "iterations of each step", "not converged", "processor time [s]", "factor [MB]", "peak memory [MB]"], cells)])
