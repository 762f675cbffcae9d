"""The hard cases: what each must survive, and whether it did."""

import csv
import math
from dataclasses import dataclass, field

import numpy as np

import figures
from exact_pages import number

CREATED_GOAL = 0.1      # % of the largest energy


@dataclass
class Hard:
    """A variant of the design's list: a deck, or one case of it."""

    what: str
    deck: str
    settings: dict = field(default_factory=dict)
    case: str = None            # of a deck that computes several
    closing: object = None      # m/s of the fastest impact: a number, or the label under which the deck prints it
    allowed: float = None       # m of penetration where no impact sets it
    expected: str = "converged"     # "not converged": there is no equilibrium; "refused": an error with exit code 2
    quick: bool = True

    def name(self):
        return "/".join(filter(None, [self.deck.split("/")[-1], self.case])) + "".join(f" {k}={v}" for k, v in self.settings.items())


def impact(what, case):
    return Hard(what, "impact", case=case, closing=4.0)


def list_of_cases():
    """The design's list, in its order."""
    junction = 2.0 + 2 * 20e6 / (2700 * 5900)       # the lid's, and what the recoil of the static pressure adds
    return [
        impact("plain: friction 0.3, ratios 1, CFL 1", "plain"), impact("friction 0", "friction_0"), impact("friction 1", "friction_1"),
        impact("friction 5", "friction_5"), impact("sticking: friction 1000", "friction_1000"),
        impact("stiffness ratio 1e2", "stiffer_1e2"), impact("stiffness ratio 1e4", "stiffer_1e4"),
        impact("stiffness ratio 1e6", "stiffer_1e6"), impact("stiffness ratio 1e-6", "softer_1e6"),
        impact("stiffness ratio 1e6, CFL 100", "stiffer_1e6_cfl_100"), impact("density ratio 50", "denser_50"),
        impact("density ratio 2500", "denser_2500"), impact("density ratio 1e4", "denser_1e4"),
        impact("density ratio 1/2500", "lighter_2500"), impact("density ratio 1e-4", "lighter_1e4"), impact("CFL 0.1", "cfl_0.1"),
        impact("CFL 10", "cfl_10"), impact("CFL 100", "cfl_100"),
        Hard("grazing, 100 cycles", "grazing", closing="fastest landing of a corner"),
        Hard("a gap that never closes", "never_closes", case="base", allowed=0.0), Hard("press fit", "press_fit", allowed=10e-6),
        Hard("held by contact alone", "held_by_contact", {"pull": 0.5}, allowed=1e-12),
        Hard("the same, pulled beyond friction", "held_by_contact", {"pull": 1.5}, expected="not converged"),
        Hard("the same without friction", "held_by_contact", {"pull": 0.5, "friction": 0}, expected="refused"),
        impact("Poisson 0.49", "poisson_0.49"), impact("Poisson 0.499", "poisson_0.499"), impact("Poisson 0.4999", "poisson_0.4999"),
        impact("Poisson -0.8", "poisson_-0.8"), impact("elements of aspect 100, flat", "aspect_flat_100"),
        impact("elements of aspect 100, long", "aspect_long_100"), impact("search direction x 1e-3", "direction_1e-3"),
        impact("search direction x 1e3", "direction_1e3"), impact("a gap half a step wide", "gap"),
        impact("friction 1, gap, CFL 10", "friction_1_gap_cfl_10"),
        Hard("plastic, no hardening, cycled: static", "plastic_cycle", case="static"),
        Hard("plastic, no hardening, cycled: dynamic", "plastic_cycle", case="dynamic"),
        Hard("the same, CFL 6.4", "plastic_cycle", {"slow": 400}, case="dynamic"),
        Hard("1e4 steps", "long_run", closing="fastest closing of a corner"),
        Hard("1e5 steps", "long_run", {"steps": 100000}, closing="fastest closing of a corner", quick=False),
        Hard("five bodies meet in an edge", "junction", closing=junction),
        Hard("the same, contact everywhere", "junction", {"bonded": 0}, closing=junction),
        Hard("the same, friction 1", "junction", {"friction": 1}, closing=junction),
        Hard("faces of one element, 3 bodies", "one_element", closing=15.0),
        Hard("faces of one element, 8 bodies", "one_element", {"count": 8}, closing=15.0),
        Hard("a bolt yields at once", "early_yield", case="yields", allowed=1e-12),
        Hard("prestress of a joint that stays open", "early_yield", case="open", allowed=1e-12),
        Hard("prestress of an open joint that closes", "early_yield", case="closes", allowed=1e-12),
        Hard("sliding under gravity, CFL 1", "../verification/sliding_block", {"n": 8, "dt": "0.25*us"}, case="thrown", closing=0.5),
        Hard("sliding under gravity, CFL 4", "../verification/sliding_block", {"n": 8, "dt": "1*us"}, case="thrown", closing=0.5),
    ]


@dataclass
class Outcome:
    """What a hard case did; None where the run says nothing of it."""

    case: Hard
    exit_code: int
    said: str                   # "converged", "said: 3 of 120 steps not converged", "refused: ..."
    iterations: float = None
    created: float = None       # % of the largest energy
    penetration: float = None   # m
    allowed: float = None       # m
    complaints: tuple = ()

    def verdict(self):
        return "**MISSED**: " + ", ".join(self.complaints) if self.complaints else "met"


def time_step(run, case):
    """dt (s) of the last dynamic step, from its table of convergence; None if all are static."""
    times = np.diff(run.table("convergence", case)["time"])
    times = times[times > 0]
    return float(times[-1]) if len(times) else None


def all_finite(folder):
    """Whether every number of every table of results is one; the indicator of an increment that was lost may be infinite."""
    results = [path for path in folder.glob("*.csv") if path.name != "convergence.csv"]
    return not any(word in ("nan", "-nan", "inf", "-inf") for path in results
                   for line in path.read_text().splitlines()[1:] for word in line.lower().split(","))


def judge(case, run):
    """The outcome of a case from its run; complaints are departures from what the design asks of every hard case."""
    if run.exit_code is None:
        return Outcome(case, None, "stopped at the time limit", complaints=("hangs",))
    if run.exit_code not in (0, 1) or not run.cases:
        refused = run.exit_code == 2
        lines = [line for line in run.text.strip().splitlines() if line.strip()]
        return Outcome(case, run.exit_code, f"refused: {lines[-1].strip()[:70]}" if refused else "failed",
                       complaints=() if refused and case.expected == "refused" else (f"exit code {run.exit_code}",))
    record = run.record(case.case)
    missed = sum(step["increments_not_converged"] for step in record["steps"])
    of = sum(step["increments"] for step in record["steps"])
    said = "converged" if missed == 0 else f"says {missed} of {of} steps are not"
    figures_ = record["figures"]
    created = figures_.get("energy created by the scheme [%]")
    penetration = figures_.get("largest penetration [m]")
    allowed = case.allowed
    if case.closing is not None:
        speed = case.closing if isinstance(case.closing, float) else run.number(case.closing)
        allowed = speed * time_step(run, case.case) / 2
    complaints = []
    if not all_finite(run.cases[case.case] if case.case else next(iter(run.cases.values()))):
        complaints.append("not a number")
    if case.expected == "refused":
        complaints.append("should be refused")
    if case.expected == "not converged" and missed == 0:
        complaints.append("says converged without equilibrium")
    if case.expected == "converged" and created is not None and created > CREATED_GOAL:
        complaints.append(f"creates {number(created, 2)} % energy")
    if allowed is not None and penetration is not None and penetration > 1.001 * allowed + 1e-15:
        complaints.append("penetrates more than v dt/2")
    return Outcome(case, run.exit_code, said, record["iterations"]["mean"], created, penetration, allowed, tuple(complaints))


def hard_cases(program, say, quick=False):
    """Runs every deck once for each of its settings and judges its cases."""
    runs, outcomes = {}, []
    for case in list_of_cases():
        if quick and not case.quick:
            continue
        key = (case.deck, tuple(case.settings.items()))
        if key not in runs:
            say(f"  {case.deck} {' '.join(f'{k}={v}' for k, v in case.settings.items())}")
            runs[key] = program.run(f"decks/hard/{case.deck}.lua", case.settings, threads=2, limit=600)
        outcomes.append(judge(case, runs[key]))
    return outcomes


def write_csv(path, outcomes):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["variant", "deck and case", "exit code", "verdict of the run", "iterations per step", "energy created [%]",
                         "largest penetration [m]", "allowed [m]", "verdict"])
        for o in outcomes:
            writer.writerow([o.case.what, o.case.name(), o.exit_code, o.said, *("" if v is None else f"{v:.4g}" for v in (
                o.iterations, o.created, o.penetration, o.allowed)), o.verdict().replace("*", "")])


HEADS = ["variant", "deck/case", "the run says", "iterations per step", "energy created (%)", "penetration (m)", "allowed (m)", "verdict"]


def rows(outcomes):
    return [[o.case.what, f"`{o.case.name()}`", o.said, number(o.iterations), number(o.created), number(o.penetration),
             number(o.allowed), o.verdict()] for o in outcomes]


def figure(outcomes):
    """Three columns of dots: iterations, energy created, penetration of what is allowed; red where the goal is missed."""
    shown = [o for o in outcomes if o.iterations is not None]
    y = np.arange(len(shown))[::-1]
    fig, axes = figures.plt.subplots(1, 3, figsize=(9, 0.175 * len(shown) + 1), sharey=True)
    fig.subplots_adjust(wspace=0.08)
    colours = [figures.MISSED if o.complaints else (figures.COLOURS[1] if o.said != "converged" else figures.COMPUTED) for o in shown]
    created = [max(o.created, 1e-6) if o.created is not None else math.nan for o in shown]
    ratio = [o.penetration / o.allowed if o.allowed and o.penetration is not None else math.nan for o in shown]
    for a, values, title, limit in zip(axes, ([o.iterations for o in shown], created, ratio),
                                       ("iterations per step", "energy created (%)", "penetration / (v dt/2)"), (None, CREATED_GOAL, 1.0)):
        a.scatter(values, y, c=colours, s=18, zorder=3)
        a.set_title(title)
        if limit:
            a.axvline(limit, color=figures.MISSED, linewidth=0.8)
    axes[0].set_xscale("log")
    axes[1].set_xscale("log")
    axes[1].set_xlim(left=5e-7)
    axes[2].set_xlim(-0.05, 1.15)
    axes[0].set_yticks(y, [o.case.what for o in shown], fontsize=7.5)
    axes[0].set_ylim(-1, len(shown))
    return fig
