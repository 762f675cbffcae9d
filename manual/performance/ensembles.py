"""What an ensemble costs in runs of one member: processor time of all members over that of one unit alone, on one thread."""

from measure import write_rows
from page import table

MOST_RUNS = 3.0     # of one unit, for 16 members
SCENES = {"bolted flanges": "decks/flanges_ensemble.lua", "sector of the separation ring": "decks/bench/sector_ensemble.lua"}


def processor_seconds(machine, deck, settings):
    """Processor time (s) and peak memory (bytes) of a whole run, mesh and results included."""
    command = [machine.build / "dygita", "run", machine.root / deck, "--quiet", "--threads", 1, "--out", machine.scratch / f"ensemble_{next(machine.numbers)}"]
    for name, value in settings.items():
        command += ["--set", f"{name}={value}"]
    _, peak, used = machine.run(command, 1800)
    return used, peak


def measure(machine, folder, quick):
    """Writes ensembles.csv: one row per scene and number of members; one member is a unit alone, with its report and state."""
    rows = []
    for scene, deck in SCENES.items():
        for members in [1, 4] if quick else [1, 4, 16]:
            machine.say(f"Ensembles: {scene}, {members}")
            used, peak = processor_seconds(machine, deck, {"alone": 1} if members == 1 else {"n": members})
            one = used if members == 1 else one
            rows.append({"scene": scene, "members": members, "processor [s]": used, "runs": used / one, "peak [MB]": peak / 1e6})
    write_rows(folder / "ensembles.csv", rows)


def goals(rows):
    return [(f"16 members of the {row['scene']}: at most {MOST_RUNS:g} runs of one", f"{row['runs']:.1f}", row["runs"] <= MOST_RUNS,
             "implicit members share operators and substitutions; local stages, explicit steps and all that watches a run are each its own") for row in rows if row["members"] == 16]


def section(rows):
    cells = [(r["scene"], f"{r['members']:.0f}", f"{r['processor [s]']:.1f}", f"{r['runs']:.1f}", f"{r['peak [MB]']:.0f}") for r in rows]
    return "\n\n".join([
        "## Ensembles", "Processor time on one thread, mesh and results included: one unit alone, with its report and state, and all members of an [ensemble](howto/ensembles.md), "
        "which share cut, matrices, factors and interface operators.",
        table(["scene", "members", "processor time [s]", "runs of one unit", "peak memory [MB]"], cells)])
