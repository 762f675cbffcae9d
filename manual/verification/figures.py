"""What all figures share: style, files that do not change from run to run, errors against size."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator  # noqa: E402

EXACT, COMPUTED, MET, MISSED = "#999999", "#0b5394", "#2e7d32", "#c62828"
COLOURS = ["#0b5394", "#c75b12", "#2e7d32", "#8e24aa", "#00838f", "#6d4c41", "#ad1457", "#455a64"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]

plt.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "dygita", "font.family": "sans-serif", "font.size": 9, "axes.titlesize": 9.5,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": "#e4e4e4", "grid.linewidth": 0.6,
    "legend.frameon": False, "legend.fontsize": 8, "lines.linewidth": 1.4, "lines.markersize": 4.5, "axes.titlelocation": "left",
})


def save(figure, path):
    """Writes an SVG without dates."""
    figure.savefig(path, format="svg", metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    plt.close(figure)


def thinned(x, y, most=700):
    """At most `most` points, evenly: histories have thousands of rows, a figure some hundred dots."""
    x, y = np.asarray(x), np.asarray(y)
    keep = np.unique(np.linspace(0, len(x) - 1, min(most, len(x))).astype(int))
    return x[keep], y[keep]


def over_exact(axes, t_exact, exact, t, computed, label="computed"):
    """A computed history over the exact one."""
    axes.plot(t_exact, exact, color=EXACT, linewidth=4, alpha=0.55, solid_capstyle="butt", label="exact")
    axes.plot(*thinned(t, computed), color=COMPUTED, linewidth=1.1, label=label)


def direct_labels(axes, ends, size=8):
    """Writes names at the right ends of curves, pushed apart where they would overlap; `ends` is [(x, y, text, colour)]."""
    if not ends:
        return
    log_y = axes.get_yscale() == "log"
    bottom, top = axes.get_ylim()
    height = axes.get_position().height * axes.figure.get_figheight() * 72
    to_points = (lambda y: (math.log(y / bottom) / math.log(top / bottom)) * height) if log_y else (
        lambda y: (y - bottom) / (top - bottom) * height)
    last = -1e9
    for x, y, text, colour in sorted(ends, key=lambda end: end[1]):
        here = max(to_points(y), last + 1.2 * size)
        axes.annotate(text, (x, y), xytext=(6, here - to_points(y)), textcoords="offset points", color=colour, fontsize=size,
                      va="center", annotation_clip=False)
        last = here


def error_axes(axes, measured):
    """Errors against size in logarithms, each with its fitted slope, goals as ticks at the size they hold for."""
    case, widths, ends = measured.case, measured.case.widths(), []
    shown = [i for i, quantity in enumerate(case.quantities) if quantity.plotted]
    for k, i in enumerate(shown):
        quantity, order = case.quantities[i], measured.order(i)
        scale = 0.01 if quantity.unit == "%" else 1.0
        errors = [abs(v - quantity.target) * scale for v in measured.values[i]]
        points = [(w, e) for w, e in zip(widths, errors) if e > 0 and math.isfinite(e)]
        if not points:
            continue
        colour = COLOURS[k % len(COLOURS)]
        axes.loglog(*zip(*points), color=colour, marker=MARKERS[k % len(MARKERS)])
        if quantity.goal is not None:
            axes.plot([widths[case.goal_at]], [quantity.goal * scale], marker="_", markersize=16, markeredgewidth=2, color=colour)
        slope = "" if order is None else f", slope {order:.2f}"
        ends.append((*max(points), short(quantity.name) + slope, colour))
    sized_ticks(axes, widths, [label for label, _ in case.sizes], case.knob)
    axes.set_title("error (1e-2 is 1 %; dash: goal)")
    axes.margins(0.08, 0.15)
    axes.figure.canvas.draw()
    direct_labels(axes, ends)


def sized_ticks(axes, widths, labels, name):
    """The sizes themselves along the logarithmic axis of widths."""
    axes.xaxis.set_major_locator(FixedLocator(widths))
    axes.xaxis.set_major_formatter(FixedFormatter(labels))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel(name)


def short(name):
    return name if len(name) <= 46 else name[:44] + "..."


def case_figure(measured, history):
    """Left what happens, where a history tells it; right the errors. `history` draws into a list of axes or is None."""
    n = getattr(history, "panels", 0)
    figure, axes = plt.subplots(1, n + 1, figsize=(3.6 * (n + 1) + 0.3, 2.9), squeeze=False)
    figure.subplots_adjust(wspace=0.27)
    if history:
        history(list(axes[0][:n]), measured)
    error_axes(axes[0][n], measured)
    return figure
