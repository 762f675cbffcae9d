#!/usr/bin/env python3
"""Picture of manual/measured-joints.md: the Brake-Reuss beam with amplitude, from one assembly to the next and in time.

    dygita run decks/verification/brake_reuss.lua --set push=50 --set spread=1 --out OUT
    dygita run decks/verification/brake_reuss.lua --set push=50 --set only=8 --set ring=0.1 --out OUT
    python3 manual/verification/brake_reuss.py OUT 25:0.834 30:1.015 40:1.41 50:1.799     # whole cycles, m/s^2 : %
"""
import csv
import pathlib
import sys

import matplotlib.pyplot as plt

from figures import COLOURS, EXACT, save

OUT = pathlib.Path(sys.argv[1]) / "brake_reuss"
CYCLES = [tuple(map(float, given.split(":"))) for given in sys.argv[2:]]
PUBLISHED = [(12.5, 178.60, 0.75), (28.1, 172.21, 2.37), (34.7, 169.77, 2.71), (50.6, 165.52, 3.37)]  # model with asperities
SHOWN = [("torque 100 %, friction 0.03, form 1.0", "as measured, friction 0.03"), ("torque 75 %, friction 0.03, form 1.0", "torque 75 %"),
         ("torque 125 %, friction 0.03, form 1.0", "torque 125 %"), ("torque 100 %, friction 0.03, form 0.5", "half the form"),
         ("torque 100 %, friction 0.03, form 1.5", "form times 1.5"), ("torque 100 %, friction 0.10, form 1.0", "friction 0.1")]


def columns(path, *names):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    found = {key.split(" [")[0]: key for key in rows[0]}
    return [[float(row[found[name]]) for row in rows] for name in names]


figure, axes = plt.subplots(2, 2, figsize=(9.2, 5.6), sharex=True)
(hz, hz_time), (percent, percent_time) = axes
for k, (case, label) in enumerate(SHOWN):
    a, frequency, damping = columns(OUT / case / "backbone.csv", "acceleration", "frequency", "damping")
    hz.plot(a, frequency, color=COLOURS[k], label=label)
    percent.plot(a, [100 * zeta for zeta in damping], color=COLOURS[k])
a, frequency, damping = zip(*PUBLISHED)
hz.plot(a, frequency, "o", color="black", label="published model")
percent.plot(a, damping, "o", color="black")
hz.fill_between([0.28, 13.5], 175.5, 180, color=EXACT, alpha=0.4, linewidth=0, label="measured")
percent.fill_between([0.28, 13.5], 0.05, 1, color=EXACT, alpha=0.4, linewidth=0)
hz.set_title("first mode (Hz), measured form with asperities")
percent.set_title("damping (% of critical)")
hz.set_ylim(bottom=152)
hz.legend(ncol=2, loc="lower left", fontsize=7)
a, frequency, damping = columns(OUT / "backbone, flat, rough" / "backbone.csv", "acceleration", "frequency", "damping")
hz_time.plot(a, frequency, color=COLOURS[0], label="first loading")
percent_time.plot(a, [100 * zeta for zeta in damping], color=COLOURS[0])
a, frequency, damping = columns(OUT / "ring-down, flat, rough" / "down.csv", "amplitude", "frequency", "damping")
hz_time.plot(a, frequency, color=COLOURS[1], marker="s", markersize=3, label="ring-down")
percent_time.plot(a, [100 * zeta for zeta in damping], color=COLOURS[1], marker="s", markersize=3)
if CYCLES:
    percent_time.plot(*zip(*CYCLES), "D", color=COLOURS[2], label="whole cycles")
    percent_time.legend(loc="upper left", fontsize=7)
hz_time.set_title("first mode (Hz), flat with asperities, friction 0.03")
percent_time.set_title("damping (% of critical)")
hz_time.legend(loc="lower left", fontsize=7)
for axis in (percent, percent_time):
    axis.set_xlabel("acceleration at the tips (m/s²)")
    axis.set_ylim(bottom=0)
figure.tight_layout()
save(figure, pathlib.Path(__file__).with_suffix(".svg"))
