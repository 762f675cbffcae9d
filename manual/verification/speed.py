"""Speed against error: every solver and knob on the scenes, as a table of runs, figures and the cheapest settings."""

import csv
import math
from dataclasses import dataclass

import figures
from exact_pages import number
from scenes import SCENES, TOLERANCES, WINDOWS

ESTIMATES = [f"error estimate, {what} [%]" for what in ("iteration", "time step", "mesh")]   # figures of run.json
LEVELS = [0.10, 0.03, 0.01, 0.003]
LINES = {"mesh": "-", "dt": "--", "tolerance": ":", "window": "-.", "safety": "--", "penalty": ":"}
COLOUR = {"latin": "#0b5394", "latin implicit": "#5b8fd6", "latin implicit tuned": "#00a0c6", "latin explicit lumped": "#6a6a00", "latin explicit tuned": "#b8860b", "monolithic": "#c75b12", "explicit one_point": "#2e7d32", "explicit full": "#8e24aa"}


@dataclass
class Row:
    """One run: what was set, what it cost, how far off it is."""

    scene: str
    solver: str         # "explicit one_point" is solver.explicit with that integration
    knob: str
    value: str
    settings: str
    option: str         # of --solver
    exit_code: int
    dofs: int = None
    steps: int = None
    iterations: int = None
    seconds: float = None
    errors: tuple = (math.nan, math.nan)
    estimates: dict = None


def curves(scene, solvers, quick):
    """[(solver, knob, [(value, settings, --solver)])] of a scene; `solvers` as Program.solvers answers them."""
    def every(values):
        return values[1:-1] if quick else values

    solvers = {name: option for name, option in solvers.items() if not scene.solvers or name in scene.solvers}
    found = [(name, "mesh", [(v, s, option) for v, s in every(scene.mesh)]) for name, option in solvers.items()]
    if scene.solvers:
        return found + [("latin", "dt", [(v, s, solvers["latin"]) for v, s in every(scene.dt) if s not in [of for _, of in scene.mesh]])]
    found += [(name, "dt", [(v, s, solvers[name]) for v, s in every(scene.dt)]) for name in ("latin", "latin implicit", "latin implicit tuned", "monolithic")
              if name in solvers]
    if "latin implicit" in solvers:
        found += [("latin implicit", knob, [(v, scene.base, f'latin{{ integration = "implicit", {knob} = {v} }}') for v in values])
                  for knob, values in (("tolerance", every(TOLERANCES)), ("window", WINDOWS))]
    if "explicit one_point" in solvers:
        found += [("explicit one_point", "safety", [(v, scene.base, f"explicit{{ penalty = 1, safety = {v} }}") for v in ("0.9", "0.45", "0.2")]),
                  ("explicit one_point", "penalty", [(v, scene.base, f"explicit{{ penalty = {v} }}") for v in ("0.01", "0.1", "1", "10")])]
    return found


def reference_run(scene, program, quick, say):
    """The run that errors are taken against, how far the next coarser one is off, and a sentence on it; None where exact."""
    if scene.exact:
        return None, None, "Errors are against the exact solution."
    fine, coarser = scene.quick_reference if quick else scene.reference
    runs = []
    for settings in (fine, coarser):
        say(f"  {scene.name}: reference {settings}")
        runs.append(program.run(scene.deck, settings, "monolithic" if program.takes_solver else None, threads=2))
    off = scene.errors(runs[1], runs[0])
    told = ", ".join(f"{k} = {v}" for k, v in fine.items())
    before = ", ".join(f"{k} = {v}" for k, v in coarser.items())
    return runs[0], off, (f"Errors are against solver.monolithic with {told}; the next coarser one ({before}) differs from it by "
                     f"{number(100 * off[0])} % in the {scene.quantities[0]} and {number(100 * off[1])} % in the {scene.quantities[1]}: "
                     "errors below that (grey band) say little.")


def measure(scene, program, solvers, reference, quick, say):
    """All runs of a scene."""
    rows = []
    for solver, knob, points in curves(scene, solvers, quick):
        say(f"  {scene.name}: {solver}, {knob}")
        for value, settings, option in points:
            told = " ".join(f"{k}={v}" for k, v in settings.items())
            run, cost = program.timed(scene.deck, settings, option, limit=240)
            row = Row(scene.name, solver, knob, value, told, option, run.exit_code)
            if run.cases and run.exit_code in (0, 1):
                record = run.record()
                row.dofs, row.seconds = record["size"]["dofs"], cost
                row.steps = sum(step["increments"] for step in record["steps"])
                row.iterations = record["iterations"]["all"]
                row.estimates = {k: v for k, v in record["figures"].items() if k.startswith("error estimate")}
                row.errors = scene.errors(run, reference)
            else:
                say(f"    {value}: exit code {run.exit_code}: {run.text.strip().splitlines()[-1:]}")
            rows.append(row)
    return rows


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scene", "solver", "knob", "value", "settings", "solver option", "exit code", "dof", "steps", "iterations",
                         "seconds", "error", "error 2", *ESTIMATES])
        for r in rows:
            writer.writerow([r.scene, r.solver, r.knob, r.value, r.settings, r.option, r.exit_code, r.dofs, r.steps, r.iterations,
                             "" if r.seconds is None else f"{r.seconds:.4g}", *(f"{e:.5g}" for e in r.errors),
                             *("" if name not in (r.estimates or {}) else f"{r.estimates[name]:.4g}" for name in ESTIMATES)])


def figure(scene, rows, floors):
    """Error against seconds for both quantities: above the solvers as the mesh is refined, below the other knobs.

    Colour tells the solver, the line the knob; names stand at the curves' ends. `floors` are the errors of the reference, drawn as
    a grey band, or None where the solution is exact.
    """
    fig, axes = figures.plt.subplots(2, 2, figsize=(9.6, 6.6))
    fig.subplots_adjust(wspace=0.68, hspace=0.33)
    for panel in (0, 1):
        of_mesh = {(r.solver, r.knob) for r in rows if r.knob == "mesh"}
        others = {(r.solver, r.knob) for r in rows} - of_mesh
        pale = {curve for curve in of_mesh if any(curve[0] == solver for solver, _ in others)}
        for a, curves_, context in ((axes[0][panel], of_mesh, set()), (axes[1][panel], others, pale)):
            draw(a, rows, panel, curves_, context, floors and floors[panel])
        axes[0][panel].set_title(f"{scene.quantities[panel]}: error, mesh refined")
        axes[1][panel].set_title("the same, other knobs (pale: mesh refined)")
        axes[1][panel].set_xlabel("seconds of computation, one thread")
    return fig


def draw(axes, rows, panel, shown, context, floor):
    """Curves `shown`, a set of (solver, knob), with their names; those of `context` pale and without."""
    ends = []
    for solver, knob in dict.fromkeys((r.solver, r.knob) for r in rows if (r.solver, r.knob) in shown | context):
        points = [(r.seconds, r.errors[panel]) for r in rows if (r.solver, r.knob) == (solver, knob)
                  and r.seconds and math.isfinite(r.errors[panel]) and r.errors[panel] > 0]
        if not points:
            continue
        colour = COLOUR.get(solver, "#555555")
        pale = (solver, knob) in context
        axes.loglog(*zip(*points), LINES.get(knob, "-"), color=colour, marker="o", markersize=3.5, alpha=0.25 if pale else 1)
        if not pale:
            ends.append((*max(points), solver if knob == "mesh" else f"{solver}, {knob}", colour))
    percent_axis(axes)
    if floor and floor > axes.get_ylim()[0]:
        axes.axhspan(axes.get_ylim()[0], floor, color="#e9e9e9", zorder=0)
    axes.figure.canvas.draw()
    to_the_right(axes, ends)


def percent_axis(axes):
    """Errors in percent at 1, 3, 10, 30 ..., from one of them to another."""
    ticks = [mantissa * 10.0**k for k in range(-8, 3) for mantissa in (1, 3)]
    low, high = axes.get_ylim()
    low, high = max(t for t in ticks if t <= low), min((t for t in ticks if t >= high), default=high)
    axes.set_ylim(low, high)
    axes.set_yticks([t for t in ticks if low <= t <= high], [f"{100 * t:g} %" for t in ticks if low <= t <= high])
    axes.minorticks_off()


def to_the_right(axes, ends):
    """Names in a column right of the axes with thin leaders, in the order of the curves' ends."""
    right = axes.get_xlim()[1]
    low, high = axes.get_ylim()
    height = axes.get_position().height * axes.figure.get_figheight() * 72
    at = [(math.log(y / low) / math.log(high / low) * height, x, y, text, colour) for x, y, text, colour in sorted(ends, key=lambda e: e[1])]
    spots, last = [], -1e9
    for want, *_ in at:
        last = max(want, last + 10)
        spots.append(last)
    spots = [spot - max(0.0, (spots[-1] if spots else 0) - height) for spot in spots]
    for i in range(len(spots) - 2, -1, -1):
        spots[i] = min(spots[i], spots[i + 1] - 10)
    for spot, (_, x, y, text, colour) in zip(spots, at):
        y_text = math.exp(math.log(low) + spot / height * math.log(high / low))
        axes.annotate(text, (x, y), xytext=(right * 1.12, y_text), textcoords="data", color=colour, fontsize=7.5, va="center",
                      annotation_clip=False, arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.5, "relpos": (0, 0.5),
                                                         "shrinkA": 1, "shrinkB": 3})


def best_of(rows, panel, level):
    """The cheapest run that reaches an error level, or None."""
    return min((r for r in rows if r.seconds and r.errors[panel] <= level), key=lambda r: r.seconds, default=None)


def cheapest(rows, panel):
    """A row a solver: the cheapest setting that reaches each level, in seconds and as it is set; last, what latin as it chooses by itself costs over the cheapest of all."""
    table = []
    for solver in dict.fromkeys(r.solver for r in rows):
        found = [best_of([r for r in rows if r.solver == solver], panel, level) for level in LEVELS]
        table.append([solver] + ["-" if best is None else f"{number(best.seconds, 2)} s ({best.knob} {best.value})" for best in found])
    ratios = ratios_to_cheapest(rows, panel)
    table.append(["*latin over the cheapest*"] + ["-" if ratio is None else number(ratio, 2) for ratio in ratios])
    return ["solver"] + [f"{100 * level:g} %" for level in LEVELS], table


def ratios_to_cheapest(rows, panel):
    """Of each level: seconds of latin as it chooses by itself over those of the cheapest of all; infinite where it alone does not reach the level, None where nobody does."""
    ratios = []
    for level in LEVELS:
        own, best = best_of([r for r in rows if r.solver == "latin"], panel, level), best_of(rows, panel, level)
        ratios.append(None if best is None else math.inf if own is None else own.seconds / best.seconds)
    return ratios


def balance(done, most=1.2):
    """How often latin as it chooses by itself is within `most` of the cheapest of all, in words."""
    ratios = [ratio for scene, rows, _ in done for panel in (0, 1) for ratio in ratios_to_cheapest(rows, panel) if ratio is not None]
    within = sum(ratio <= most for ratio in ratios)
    return (f"Of {len(ratios)} levels of error that any of the runs reaches, *latin*, as it chooses by itself, is within {most:g} of the cheapest of all at {within}, "
            f"within 2 at {sum(ratio <= 2 for ratio in ratios)}. Where it is not, the paragraph of the scene says what bounds it.")


def against_latin(rows):
    """How other solvers' seconds compare with latin's at the same settings, the mesh knob."""
    told, cost = [], {(r.solver, r.settings): r.seconds for r in rows if r.knob == "mesh" and r.seconds}
    for solver in dict.fromkeys(solver for solver, _ in cost if solver != "latin"):
        ratios = [s / cost["latin", key] for (name, key), s in cost.items() if name == solver and ("latin", key) in cost]
        told.append(f"{solver} {number(min(ratios), 2)} to {number(max(ratios), 2)}")
    return "Seconds over those of latin at the same meshes and dt: " + "; ".join(told) + "." if told else ""


def write_references(path, done):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scene", "reference off by", "reference off by, error 2", "reference"])
        writer.writerows([scene.name, *(floors or ("", "")), told] for scene, _, floors, told in done)


def kept(folder):
    """What an earlier command measured, from speed.csv and speed_references.csv: as `measured`."""
    def number_of(text, kind=float):
        return kind(text) if text else None

    with open(folder / "speed_references.csv", newline="") as file:
        references = {row["scene"]: row for row in csv.DictReader(file)}
    with open(folder / "speed.csv", newline="") as file:
        lines = list(csv.DictReader(file))
    done = []
    for scene in SCENES:
        reference = references[scene.name]
        floors = (number_of(reference["reference off by"]), number_of(reference["reference off by, error 2"]))
        rows = [Row(r["scene"], r["solver"], r["knob"], r["value"], r["settings"], r["solver option"], number_of(r["exit code"], int),
                    number_of(r["dof"], int), number_of(r["steps"], int), number_of(r["iterations"], int), number_of(r["seconds"]),
                    (float(r["error"]), float(r["error 2"]))) for r in lines if r["scene"] == scene.name]
        done.append((scene, rows, floors if floors[0] else None, reference["reference"]))
    return done


def measured(program, say, quick, only):
    """Runs the scenes: [(Scene, rows, errors of the reference, sentence on it)]."""
    solvers, done = program.solvers(), []
    for scene in SCENES:
        if only and scene.name != only:
            continue
        reference, floors, told = reference_run(scene, program, quick, say)
        done.append((scene, measure(scene, program, solvers, reference, quick, say), floors, told))
    return done


def scenes(program, folder, say, quick=False, only=None, keep=False):
    """Runs every scene, or takes what an earlier command kept; writes figures and tables: [(Scene, rows, sentence)]."""
    done = kept(folder) if keep else measured(program, say, quick, only)
    for scene, rows, floors, _ in done:
        figures.save(figure(scene, rows, floors), folder / f"speed_{scene.name}.svg")
    if not only and not keep:
        write_csv(folder / "speed.csv", [row for _, rows, _, _ in done for row in rows])
        write_references(folder / "speed_references.csv", done)
    return [(scene, rows, told) for scene, rows, _, told in done]
