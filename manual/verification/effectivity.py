"""What the runs' own error estimates are worth: estimated over true, from the program tests/bench/effectivity.cpp."""

import csv
import io
import math
import subprocess
from pathlib import Path

import figures
from exact_pages import number

HEADS = ["scene", "knob", "value", "estimated (%)", "true (%)", "estimated / true"]
KNOBS = {"tolerance": "iteration", "steps": "time step", "cells": "mesh", "cells and steps": "mesh and time step"}
SCENES = {"static": "static steps, mesh", "frequency": "frequencies", "amplitude": "amplitudes", "spectrum (dB)": "bands of spectra"}  # of scenes.lua


def run(program, folder, say):
    """Rows of its CSV, also written to effectivity.csv; None where the program has not been built."""
    if not program or not Path(program).exists():
        say("  not built: build the target 'effectivity'")
        return None
    say("  effectivity of the error estimates")
    done = subprocess.run([program], capture_output=True, text=True, check=True)
    return read(done.stdout, folder / "effectivity.csv")


def read(text, path):
    """The rows of six fields, without the heads; decks print other lines in between. Writes them to `path`."""
    rows = [row for row in csv.reader(io.StringIO(text)) if len(row) == len(HEADS)]
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    return rows[1:]


def shown(rows):
    return [[scene, knob, value, *(number(float(v)) for v in values)] for scene, knob, value, *values in rows]


def knob_of(row):
    return row[1] if row[1] in SCENES else row[1].split(" (")[0]


def scene_of(row):
    """The scene, with what the knob says of the masses."""
    return row[0] + row[1][len(knob_of(row)):]


def worst(rows):
    """A sentence for each knob: between what factors the estimates are off."""
    told = []
    for knob, name in (KNOBS | SCENES).items():
        ratios = [float(row[5]) for row in rows if knob_of(row) == knob and math.isfinite(float(row[5])) and float(row[5]) > 0]
        if ratios:
            told.append(f"{name} {number(min(ratios), 2)} to {number(max(ratios), 2)}")
    return "Estimated over true: " + "; ".join(told) + ". Above 1 an estimate is on the safe side."


def figure(rows):
    """Estimated against true errors: on the diagonal an estimate is right, above it safe."""
    knobs = [knob for knob in KNOBS if any(knob_of(row) == knob for row in rows)]
    fig, axes = figures.plt.subplots(1, len(knobs), figsize=(3.3 * len(knobs), 3.0), squeeze=False)
    fig.subplots_adjust(wspace=0.3)
    scenes = list(dict.fromkeys(scene_of(row) for row in rows))
    for a, knob in zip(axes[0], knobs):
        values = []
        for k, scene in enumerate(scenes):
            points = [(float(row[4]), float(row[3])) for row in rows if scene_of(row) == scene and knob_of(row) == knob]
            points = [p for p in points if min(p) > 0]
            values += [v for p in points for v in p]
            if points:
                marker, colour = figures.MARKERS[k % len(figures.MARKERS)], figures.COLOURS[k % len(figures.COLOURS)]
                a.loglog(*zip(*points), marker=marker, color=colour, linewidth=0.8, label=scene)
        ends = [min(values), max(values)]
        a.plot(ends, ends, color=figures.EXACT, linewidth=3, alpha=0.5, zorder=0)
        a.set_title(f"{KNOBS[knob]}: estimated (%)")
        a.set_xlabel("true (%)")
        a.legend(loc="best", fontsize=6.5)
    return fig
