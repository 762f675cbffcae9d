"""Runs of several MPI ranks on this machine, against one process and against the model that is then asked for larger ones (manual, Several machines)."""

import json
import os
import shutil
import time


import figures
from measure import write_rows, read_rows
from page import table
from ranks_model import BANDWIDTH, LATENCY, Costs, Network, Pattern, predict_rings, saved, step

RING = "decks/bench/ring.lua"
SCENES = {"explicit": ("latin{ integration = 'explicit' }", 24), "implicit": ("latin{ integration = 'implicit' }", 24)}
BLOCKS = "decks/bench/blocks.lua"
ADDED = 8e9      # bytes a second that a processor adds up
SHOWN = 70       # instants of a run at which outputs want whole bodies: stress errors, scenes, the turning picture (stress beyond yield: 200 a step more)


def difference(folder, other):
    """Largest difference of the tables of two runs, over the largest number of each column that is not the balance of others; 0: the same bits."""
    largest = 0.0
    for path in folder.glob("*.csv"):
        if path.read_bytes() == (other / path.name).read_bytes():
            continue
        for row_here, row_there in zip(one := read_rows(path), read_rows(other / path.name)):
            for name, value in row_here.items():
                if isinstance(value, float) and not any(word in name for word in ("balance", "indicator", "iterations")):
                    size = max(abs(row[name]) for row in one)
                    largest = max(largest, abs(value - row_there[name]) / size if size else 0.0)
    return largest


def run(machine, ranks, solver, settings, deck=RING):
    """run.json and folder of a deck on so many ranks of one thread."""
    out = machine.scratch / f"ranks_{next(machine.numbers)}"
    command = [shutil.which("mpirun"), "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    command += [machine.build / "dygita", "run", machine.root / deck, "--quiet", "--no-frames", "--threads", "1", "--out", out, "--solver", solver]
    for name, value in settings.items():
        command += ["--set", f"{name}={value}"]
    began = time.monotonic()
    _, _, used = machine.run(command, 900)
    share = used / (time.monotonic() - began) / min(ranks, os.cpu_count() or 1)
    record = next(out.glob("*/*/run.json"))
    return json.loads(record.read_text()), record.parent, share


def row_of(scene, ranks, record, share, off):
    shock, size = record["steps"][-1], record["size"]["dofs"]
    of_each = record.get("ranks", {}).get("of_each", [])
    n = shock["increments"]
    pieces = record.get("ranks", {}).get("pieces", [])
    heaviest = max((sum(p["seconds"] for p in pieces if p["rank"] == r) for r in range(ranks)), default=0.0)
    total = sum(p["seconds"] for p in pieces)
    row = {"scene": scene, "ranks": ranks, "bodies": len(record["substructures"]), "dofs": size, "steps": n, "increments per step": shock["iterations"] / n,
           "ms per step": 1e3 * shock["seconds"] / n, "share of the processors": share, "tables differ by": off, "heaviest over mean, unknowns": 1.0, "heaviest over mean, seconds": 1.0}
    for kind in ("neighbours", "all", "results"):
        row[f"messages per step, {kind}"] = sum(r["messages"][kind] for r in of_each) / n
        row[f"kB per step, {kind}"] = 1e-3 * sum(r["bytes"][kind] for r in of_each) / n
    row["MB of a rank at most"] = 1e-6 * max((r["memory"]["peak"] for r in of_each), default=0.0)  # one process does not tell
    row["waited, share"] = max((r["seconds_waited"] for r in of_each), default=0.0) / shock["seconds"]
    if of_each:
        row["heaviest over mean, unknowns"] = max(r["unknowns"] for r in of_each) * ranks / size
        row["heaviest over mean, seconds"] = heaviest * ranks / total
    return row


def costs_of(alone, share, two, pattern, how):
    """Costs of one processor: of pieces from two ranks' own clocks, of the rest from the phases of one process and its share of the processor; what passes from what two ranks sent."""
    shock, seconds = two["steps"][-1], {phase: share * value for phase, value in alone["seconds"].items()}
    n, inc = shock["increments"], shock["iterations"] / shock["increments"]
    here, shared = two["ranks"]["of_each"]
    pieces = sum(p["seconds"] for p in two["ranks"]["pieces"])
    asked = (here["bytes"]["results"] + shared["bytes"]["results"]) / n / 8 / shared["unknowns"]
    gathered = (here["bytes"]["all"] + shared["bytes"]["all"]) / n
    return Costs(unknown=pieces / n / inc / pattern.total(), point=(seconds["local stage"] + seconds["acceleration"]) / n / inc / pattern.points(),
                 booked=seconds["laws and energies"] / n / pattern.points(), shown=seconds["output"] / n / pattern.total(), fields=asked,
                 questions=here["messages"]["results"] / n / shared["pieces"], sums=max(1.0, here["messages"]["all"] / n - 4) / inc, increments=inc,
                 looks=min(1.0, SHOWN / n), gathered=gathered / len(pattern.unknowns), growth=1 / 3 if how == "implicit" else 0.0,
                 piece=pattern.total() / len(pattern.unknowns), added=1 / ADDED, exchanges=3.0 if how == "implicit" else 1.0)


def predict_here(records, share, cores, how):
    """share: of the processor, that one process had. What the model says of the runs that were measured."""
    pattern = Pattern.of(records[2])
    costs = costs_of(records[1], share, records[2], pattern, how)
    found = {}
    for ranks, record in records.items():
        owners = [p["rank"] for p in record["ranks"]["pieces"]] if ranks > 1 else None
        found[ranks] = step(pattern, ranks, costs, Network(LATENCY, BANDWIDTH, cores), owners)
    return pattern, costs, found


def measure_windows(machine, quick):
    """Rows of a scene on 2 ranks, a row a window: iterations, and what one process takes for them."""
    rows = []
    for cfl in (1, 4):
        for window in (1, 2, 5, 10):
            solver = f"latin{{ integration = 'implicit', window = {window} }}"
            settings = {"cells": 8 if quick else 12, "cfl": cfl, "steps": 20}
            record, _, share = run(machine, 2, solver, settings, BLOCKS)
            row = {"cfl": cfl, "window": window, "iterations": record["steps"][-1]["iterations"] / record["steps"][-1]["increments"]}
            if window == 1:
                alone, _, share = run(machine, 1, solver, settings, BLOCKS)
                n, seconds = row["iterations"], {phase: share * value / 20 for phase, value in alone["seconds"].items()}
                row |= {"s of an iteration": (seconds["interface operator"] + seconds["local stage"] + seconds["acceleration"]) / n, "s around": seconds["forward"] + seconds["backward"]}
            row["messages sent a step"] = sum(sum(rank["messages"][kind] for kind in ("neighbours", "all")) for rank in record["ranks"]["of_each"]) / 20
            rows.append(row)
            machine.say(f"Ranks: dt {cfl} h/c, window {window}: {row['iterations']:.1f} iterations")
    return rows


def measure(machine, folder, quick):
    """Writes ranks.csv, a row a run, with what the model says of it, ranks_pattern.json, what the model is fed with, and ranks_model.csv, a row a larger ring."""
    rows, measured = [], {}
    if not shutil.which("mpirun"):
        machine.say("Ranks: there is no mpirun")
        return
    cores = os.cpu_count() or 1
    for how, (solver, bolts) in SCENES.items():
        settings = {"bolts": 6 if quick else bolts, "steps": 4 if quick else 100}
        records, folders, shares = {}, {}, {}
        for ranks in (1, 2, 4):
            machine.say(f"Ranks: {how}, {ranks}")
            records[ranks], folders[ranks], shares[ranks] = run(machine, ranks, solver, settings)
        pattern, costs, model = predict_here(records, shares[1], cores, how)
        measured[how] = pattern, costs
        for ranks, record in records.items():
            row = row_of(how, ranks, record, shares[ranks], difference(folders[1], folders[ranks]))
            times = model[ranks]
            rows.append(row | {"model: ms per step": 1e3 * times["all"], "model: kB per step": 1e-3 * times["bytes"]})
    (folder / "ranks_pattern.json").write_text(saved(measured, measure_windows(machine, quick)) + "\n")
    write_rows(folder / "ranks_model.csv", predict_rings(measured, quick))
    write_rows(folder / "ranks.csv", rows)
    for row in rows:
        machine.say(f"{row['scene']}, {row['ranks']} ranks: {row['ms per step']:.0f} ms a step, model {row['model: ms per step']:.0f} ms; "
                    f"{sent(row):.0f} kB a step, model {row['model: kB per step']:.0f} kB")


def sent(row):
    return sum(row[f"kB per step, {kind}"] for kind in ("neighbours", "all", "results"))


def goals(rows):
    equal = max(r["tables differ by"] for r in rows if r["scene"] == "explicit")
    near = max(r["tables differ by"] for r in rows)
    off = max(abs(r["model: kB per step"] / sent(r) - 1) for r in rows if r["ranks"] == 4)
    return [("tables of explicit bodies on 2 and 4 ranks: those of one process, bit for bit", f"{equal:.1g}" if equal else "the same bits", equal == 0.0, ""),
            ("tables of implicit bodies, equal but turned, on 2 and 4 ranks: within 1e-6", f"{near:.1g}", near <= 1e-6, "each rank has a factor of its own"),
            ("bytes a step of 4 ranks, predicted from what 2 sent: within 25 % of those sent", f"{100 * off:.0f} %", off <= 0.25, "nodes that more than two pieces share")]


def figure(rows, folder):
    model = read_rows(folder / "ranks_model.csv")
    picture, axes = figures.plt.subplots(1, 2, figsize=(7.4, 3.0))
    picture.subplots_adjust(wspace=0.3)
    forms = ["explicit", "implicit"]
    for size, colour in zip((1e7, 1e8, 1e9), figures.COLOURS):
        for form, line in zip(forms, ("-", "--")):
            mine = [r for r in model if r["scaling"] == "strong" and r["unknowns"] == size and r["pieces"] == form]
            axes[0].loglog([r["ranks"] for r in mine], [r["speed-up"] for r in mine], line, color=colour,
                           label=f"{size:.0e}".replace("e+0", "e") + " unknowns" if form == forms[0] else None)
    ends = sorted({r["ranks"] for r in model})
    axes[0].loglog(ends, ends, color=figures.EXACT, linewidth=0.8)
    axes[0].set_title("strong scaling: speed-up")
    axes[0].legend()
    for form, line, marker in zip(forms, ("-", "--"), figures.MARKERS):
        mine = [r for r in model if r["scaling"] == "weak" and r["pieces"] == form]
        axes[1].semilogx([r["ranks"] for r in mine], [r["efficiency"] for r in mine], line, marker=marker, color=figures.COMPUTED, label=form)
    axes[1].set_title("weak scaling, 244,000 unknowns a rank: efficiency")
    axes[1].set_ylim(0, 1.45)
    axes[1].legend(loc="upper right")
    for a in axes:
        a.set_xlabel("ranks")
    figures.save(picture, folder / "ranks.svg")


def section(rows):
    has_memory = any(r.get("MB of a rank at most") for r in rows)  # not in what an earlier version measured
    cells = [(r["scene"], f"{r['ranks']:.0f}", f"{r['ms per step']:.0f}", f"{r['model: ms per step']:.0f}", f"{sum(r[f'messages per step, {k}'] for k in ('neighbours', 'all', 'results')):.0f}",
              f"{r['kB per step, neighbours']:.0f} / {r['kB per step, all']:.0f} / {r['kB per step, results']:.0f}", f"{r['model: kB per step']:.0f}",
              f"{100 * r['waited, share']:.0f} %", f"{r['heaviest over mean, unknowns']:.2f} / {r['heaviest over mean, seconds']:.2f}", f"{100 * r['share of the processors']:.0f} %", f"{r['tables differ by']:.1g}",
              *([f"{r['MB of a rank at most']:.0f}" if r.get("MB of a rank at most") else ""] if has_memory else [])) for r in rows]
    return "\n\n".join([
        "## Ranks", f"`{RING}`: {rows[0]['bodies']:.0f} bodies, {rows[0]['dofs']:.0f} unknowns, {rows[0]['increments per step']:.0f} explicit increments a time step of the deck, or "
        "implicit ones; 1, 2 and 4 ranks of one thread on the processors named above, which other programs used as well. Sums over the ranks; "
        "*waited*: of the rank that waited longest. *Model*: replayed from two ranks' pattern and one process's seconds ([Several machines](parallel.md)).",
        table(["scene", "ranks", "ms per step", "model", "messages per step", "kB per step: neighbours / all / results", "model, all", "waited", "heaviest over mean: unknowns / seconds", "share of the processors", "tables differ by",
               *(["MB of a rank at most"] if has_memory else [])], cells)])


