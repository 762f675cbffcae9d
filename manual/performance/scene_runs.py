"""Scenes at growing sizes, as LATIN chooses by itself and implicit: seconds by phase, iterations, memory; one thread and two."""

import figures
from measure import PHASES, write_rows
from page import table

FLANGES, BLOCKS = "decks/bench/even_flanges.lua", "decks/bench/blocks.lua"
MOST_BYTES = 20 * 2**30
FEWEST_RUNS, MOST_RUNS, LONG_ENOUGH = 5, 15, 60    # of a scene on each number of threads; seconds of all of them
MOST_CROWDED = 5e4                # unknowns up to which two runs of two threads share two processors
COLOURS = ["#cfd8dc", "#90a4ae", "#0b5394", "#c75b12", "#2e7d32", "#8e24aa", "#00a0c6", "#6d4c41", "#ad1457"]


def asked(machine, quick):
    """[(scene, deck, settings, solver, numbers of threads, limit)]; a scene of a few steps says so in its settings."""
    many = {"bx": 4, "by": 4, "bz": 4}
    few = {"bx": 2, "by": 2, "bz": 2}
    if quick:
        return [("bolted flanges", FLANGES, {"size": "4*mm"}, None, machine.threads, 60),
                ("blocks, 8", BLOCKS, {"cells": 12, "steps": 20} | few, None, machine.threads, 60)]
    most = machine.most_unknowns
    cut = 'latin{ integration = "implicit", pieces = 8 }' if machine.cuts else None
    found = []
    for size, unknowns, duration in (("4*mm", 6618, "200*us"), ("2.12*mm", 33480, "200*us"), ("1.4*mm", 100128, "40*us")):
        for name, solver in (("bolted flanges", None), ("bolted flanges, implicit", 'latin{ integration = "implicit" }')):
            if unknowns <= most:
                found.append((name, FLANGES, {"size": size, "duration": duration}, solver, machine.threads, 300))
    if machine.cuts and most > 1e5:
        found.append(("bolted flanges, 8 pieces per part", FLANGES, {"size": "1.4*mm", "duration": "40*us"}, cut, machine.threads, 300))
    found += [("bolted flanges", FLANGES, {"size": size, "duration": duration}, None, machine.threads[-1:], 600)
              for size, unknowns, duration in (("0.96*mm", 321504, "20*us"), ("0.64*mm", 964884, "10*us")) if unknowns <= most]
    for cells, bricks, steps in ((12, few, 200), (20, few, 200), (32, few, 200), (32, many, 200), (46, many, 20), (69, many, 10)):
        if 3 * (cells + bricks["bx"])**3 > most:
            continue
        threads = machine.threads if cells < 46 else machine.threads[-1:]
        found.append((f"blocks, {bricks['bx']**3}", BLOCKS, {"cells": cells, "steps": steps} | bricks, None, threads, 600))
    return found


def runs_of(machine, deck, settings, solver, threads, limit, quick):
    """{threads: DeckRun} and {threads: seconds} of two processes side by side, the fastest of several where they are short: in turn, since machines change their speed."""
    best, spent, pair = {}, 0.0, {}
    for n in range(1 if quick or len(threads) < 2 else MOST_RUNS):
        for t in threads:
            run = machine.deck(deck, settings, solver, t, limit)
            took = run.record["seconds"]["all"]
            spent += took
            if t not in best or took < best[t].record["seconds"]["all"]:
                best[t] = run
        if 2 in threads and len(threads) > 1:
            for t in (1, 2) if best[2].dofs < MOST_CROWDED else (1,):
                took = machine.side_by_side(2, deck, settings, solver, limit, t)
                spent += took
                pair[t] = min(took, pair.get(t, took))
        if n + 1 >= FEWEST_RUNS and spent > LONG_ENOUGH:
            break
    return best, pair


def measure(machine, folder, quick):
    """Writes scenes.csv: one row per scene and number of threads."""
    rows = []
    for scene, deck, settings, solver, threads, limit in asked(machine, quick):
        machine.say(f"Scene: {scene} {settings}, {' and '.join(map(str, threads))} thread(s)")
        try:
            runs, pair = runs_of(machine, deck, settings, solver, threads, limit, quick)
        except RuntimeError as failure:
            machine.say(f"  left out: {failure}")
            continue
        rows += [row_of(scene, settings, t, run, pair if t == 2 else {}) for t, run in runs.items()]
    write_rows(folder / "scenes.csv", rows)


def row_of(scene, settings, threads, run, pair):
    shock, record = run.shock, run.record
    every = sum(step["iterations"] for step in record["steps"])
    iterated = record["size"]["interface_unknowns"]     # of the shock: none where it is explicit
    local = record["seconds"]["local stage"] / every / iterated * 3e9 if iterated else ""
    return {"scene": scene, "settings": " ".join(f"{k}={v}" for k, v in settings.items()), "dofs": run.dofs,
            "interface unknowns": iterated, "threads": threads, "steps": shock["increments"],
            "not converged": sum(step["increments_not_converged"] for step in record["steps"]),
            "iterations per step": shock["iterations"] / shock["increments"], "shock [s]": shock["seconds"], "all [s]": record["seconds"]["all"],
            "two processes [s]": pair.get(1, ""), "crowded [s]": pair.get(2, ""), "static [s]": sum(step["seconds"] for step in record["steps"][:-1]), "local stage [ns per point]": local,
            "factors [MB]": record["figures"]["memory of factors and interface operators [MB]"], "peak [MB]": run.peak_bytes / 1e6,
            "share of the processor": run.share} | {phase: record["seconds"].get(phase, 0.0) for phase in PHASES}


def speed_up(rows):
    """[(scene, unknowns, time on one thread over that on two, of the whole run, and what two processes of one thread get done in the time of one)]"""
    alone = {(r["scene"], r["settings"]): r["all [s]"] for r in rows if r["threads"] == 1}
    return [(r["scene"], r["dofs"], alone[r["scene"], r["settings"]] / r["all [s]"], 2 * alone[r["scene"], r["settings"]] / r["two processes [s]"]) for r in rows
            if r["threads"] == 2 and (r["scene"], r["settings"]) in alone]


def goals(rows):
    done = []
    paper = min((r for r in rows if r["scene"] == "bolted flanges"), key=lambda r: r["dofs"])
    best = min(r["all [s]"] for r in rows if r["scene"] == "bolted flanges" and r["dofs"] == paper["dofs"])
    if paper["dofs"] < 1e4:
        done.append((f"the paper's example ({paper['dofs']:.0f} unknowns, {paper['steps']:.0f} steps; 30 minutes there): under 3 s in all", f"{best:.2f} s", best < 3,
                     "the phases below"))
    speeds = speed_up(rows)
    if speeds:
        large = [s for s in speeds if s[1] > 3e4] or speeds
        scene, dofs, value, most = min(large, key=lambda s: s[2])
        done.append((f"two threads at least 1.7 x one on the whole run, in every scene above 30k unknowns (least: {scene}, {dofs / 1e3:.0f}k; "
                     f"most of all: {max(s[2] for s in speeds):.2f})", f"{value:.3f}", value >= 1.7,
                     f"what one thread does (mesh, collecting results), and the machine: two *processes* of one thread side by side, with nothing in common, got {most:.2f} there"))
        scene, dofs, value, most = min(large, key=lambda s: s[2] / s[3])
        done.append((f"two threads at least 0.85 of what two processes of one thread get done side by side, in every such scene (least: {scene}, {dofs / 1e3:.0f}k, "
                     f"{value:.2f} and {most:.2f}; processes got {min(s[3] for s in large):.2f} to {max(s[3] for s in large):.2f})", f"{value / most:.2f}", value / most >= 0.85,
                     "what one thread does (mesh, collecting results)"))
    crowded = [(r["scene"], r["dofs"], r["crowded [s]"] / r["two processes [s]"]) for r in rows if r.get("crowded [s]")]
    if crowded:
        scene, dofs, value = max(crowded, key=lambda c: c[2])
        done.append((f"threads give way: two runs of two threads on two processors take at most 1.2 x two of one thread, where they were run (most: {scene}, {dofs / 1e3:.0f}k)",
                     f"{value:.2f}", value <= 1.2, "what is kept in caches for two is lost when they take turns"))
    largest = max(rows, key=lambda r: r["dofs"])
    if largest["dofs"] > 9e5:
        done.append((f"1M unknowns within 20 GiB ({largest['scene']}, {largest['dofs'] / 1e6:.2f}M; {largest['steps']:.0f} steps run; more of them add the interface fields kept, 512 MB at most)",
                     f"{largest['peak [MB]'] * 1e6 / 2**30:.1f} GiB", largest["peak [MB]"] * 1e6 < MOST_BYTES, "factors and interface operators"))
    else:
        done.append(("1M unknowns within 20 GiB", "", None, "no scene of that size was run"))
    return done


def figure(rows, folder):
    picture, axes = figures.plt.subplots(figsize=(7.4, 0.25 * len(rows) + 1.3))
    labels = [f"{r['scene']}, {r['dofs'] / 1e3:.0f}k, {r['threads']:.0f} thr" for r in rows][::-1]
    left = [0.0] * len(rows)
    for phase, colour in zip(PHASES, COLOURS):
        widths = [r[phase] / sum(r[p] for p in PHASES) for r in rows][::-1]
        axes.barh(range(len(rows)), widths, left=left, color=colour, label=phase, height=0.7)
        left = [a + b for a, b in zip(left, widths)]
    axes.set_yticks(range(len(rows)), labels)
    axes.set_xlim(0, 1)
    axes.set_title("where the time goes: share of each phase in the whole run")
    axes.grid(axis="y", visible=False)
    axes.legend(ncol=5, loc="upper left", bbox_to_anchor=(-0.25, -0.12 - 0.2 / len(rows)))
    figures.save(picture, folder / "scenes.svg")


def section(rows):
    cells = [(r["scene"], f"{r['dofs']:.0f}", f"{r['threads']:.0f}", f"{r['steps']:.0f}", f"{r['iterations per step']:.1f}", f"{r['static [s]']:.2f}",
              f"{r['shock [s]']:.2f}", f"{1e3 * r['shock [s]'] / r['steps']:.1f}", f"{r['assemble'] + r['factor']:.2f}", f"{r['all [s]']:.2f}",
              f"{r['two processes [s]']:.2f}" if r["two processes [s]"] else "", f"{r['crowded [s]']:.2f}" if r.get("crowded [s]") else "",
              f"{r['factors [MB]']:.0f}", f"{r['peak [MB]']:.0f}", f"{r['local stage [ns per point]']:.0f}" if r["local stage [ns per point]"] else "explicit", f"{100 * r['share of the processor']:.0f} %") for r in rows]
    failed = [f"{r['scene']} at {r['dofs']:.0f}: {r['not converged']:.0f} steps" for r in rows if r["not converged"]]
    return "\n\n".join(filter(None, [
        "## Scenes", f"`{FLANGES}` and `{BLOCKS}` (a cube in 8 or 64 bricks, contact across its middle, CFL 1). *Steps*: of the shock as run here; "
        "the largest take few. Runs on one and on two threads alternated, five times or, if short, up to fifteen, and the fastest of each counts. So did two single-thread processes side by side, which show what the machine offers a second thread, and (*crowded*) two processes of two threads. *Factors*: of the last step, with interface operators. *Peak*: memory of the whole program. *Local stage*: nanoseconds an iteration "
        "and three interface unknowns, where the shock is not explicit. *Processor had*: processor time over elapsed time times threads; a thread that waits and would yield counts as busy.",
        "![Where the time goes](performance/scenes.svg)",
        table(["scene", "unknowns", "threads", "steps", "iterations per step", "static s", "shock s", "ms per step", "assembly and factor s", "all s", "two processes s", "crowded s", "factors MB",
               "peak MB", "local stage", "processor had"], cells),
        failed and "Not converged: " + "; ".join(failed) + "."]))
