"""The exact cases: decks, the sizes they run at, what is measured, and the goals of verification."""

import math
from dataclasses import dataclass, field

import numpy as np


ROUND_OFF = 1e-10       # relative errors below it have no order


@dataclass
class Quantity:
    """A number that a deck prints, and the goal it is held against."""

    label: str                  # in the deck's line
    name: str                   # in tables
    unit: str = "%"
    goal: float = None          # |measured - target| at most this; None: no goal is set
    target: float = 0.0
    goal_text: str = None
    theory: float = None        # order of convergence of theory, held within 0.1
    plotted: bool = True        # in the figure of error against size
    fitted: bool = True         # an order is worth fitting

    def missed(self, value):
        return not abs(value - self.target) <= self.goal * (1 + 1e-12)

    def goal_shown(self):
        if self.goal_text:
            return self.goal_text
        return "none set" if self.goal is None else f"{self.goal:g} {self.unit}".strip()


@dataclass
class Case:
    number: str                 # in the design's list of exact cases
    name: str
    title: str
    deck: str
    what: str
    exact: str
    knob: str                   # what changes from size to size
    sizes: list                 # (value of the knob as text, settings)
    quantities: list
    goal_at: int = 0            # index of the size at which the goals hold
    x: list = field(default_factory=list)   # the knob as a number that errors fall with, by default 1/n

    note: str = ""
    compare: bool = False       # also with the other solvers, at the size of the goals
    history: str = None         # name of the function of histories.py that draws left of the errors

    def widths(self):
        return self.x or [1 / float(label) for label, _ in self.sizes]


def of_n(*values, **more):
    return [(f"{n}", {"n": n, **more}) for n in values]


def percent(label, name, goal=None, **more):
    return Quantity(label, name, "%", goal, **more)


BOUNCING_BAR = Case(
    "1", "bouncing_bar", "Bouncing bar", "decks/verification/bouncing_bar.lua",
    "An elastic bar falls on a rigid wall, bounces twice and is back where it was dropped after 16/3 "
    "(Doyen, Ern, Piperno 2011).",
    "d'Alembert: in contact for 2 L/c from t = 1 and from t = 11/3, pressure 300 to 500 and 500 to 300, energy kept.",
    "n", of_n(50, 100, 200, 400), [
        percent("place until the release", "position until first release, max / drop height", 0.5),
        percent("place after a period", "position after a full period / drop height", 4),
        percent("place over a period", "position over the period, max / drop height", None),
        percent("pressure in impact 1", "pressure in the first impact, rms / mean", 2),
        percent("pressure in impact 2", "pressure in the second impact, rms / mean", 2),
        Quantity("spells of contact in impact 1", "contact phases, first impact", "", 0, 1, "1", plotted=False, fitted=False),
        Quantity("spells of contact in impact 2", "contact phases, second impact", "", 0, 1, "1", plotted=False, fitted=False),
        percent("impulse of impact 1", "impulse of the first impact", plotted=False),
        percent("impulse of impact 2", "impulse of the second impact", plotted=False),
        percent("energy exchanged", "numerical dissipation / (weight x drop)", 1),
    ], 1, compare=True, history="bouncing_bar",
    note="dt = 0.5 h/c. Theory gives no order for impacts: a front is smeared over some cells. Where all mass is at the nodes (latin, "
         "monolithic) each impact dissipates the energy of the end node, of order h, and the second comes late; masses tuned to dt and a contact "
         "without mass (latin tuned) avoid both.")

TWO_BARS = Case(
    "2", "two_bars", "Two equal bars head on", "decks/verification/two_bars.lua",
    "Two equal bars meet at 100 m/s each, have turned all kinetic into strain energy at L/c, and part at 2 L/c.",
    "stress -rho c v = -100 MPa for 2 L/c = 2 us, then none; at 1 us all energy is strain energy.",
    "n", of_n(50, 100, 200, 400), [
        percent("rms error", "stress, rms over the contact time less 5 % at each end", 1),
        percent("the same, max error", "stress, max over the same", 1),
        Quantity("release, time steps late", "release, time steps late", "steps", 2, plotted=False, fitted=False),
        Quantity("spells of contact", "contact phases", "", 0, 1, "1", plotted=False, fitted=False),
        percent("strain energy at L / c", "strain energy at L/c / all energy", plotted=False, fitted=False),
        percent("energy exchanged", "numerical dissipation / all energy"),
    ], 1, compare=True, history="two_bars", note="dt = 0.5 h/c.")

UNEQUAL_BARS = Case(
    "3", "unequal_bars", "Unequal bars", "decks/verification/unequal_bars.lua",
    "A short stiff bar runs into a long soft one: the contact force ends in stages.",
    "characteristics: v Z1 Z2/(Z1 + Z2) = 105.4 MPa for 2 T, a third of it for 2 T, a ninth for T, then free.",
    "n", of_n(20, 40, 80, 160), [
        percent("stress on the plateaus", "stress on the plateaus, rms of the first"),
        Quantity("release, part of T late", "release, part of T late", "T", plotted=True),
        percent("momentum of the right bar", "momentum of the right bar", plotted=False, fitted=False),
    ], 1, compare=True, history="unequal_bars", note="n cells per transit T of the short bar, dt = 0.5 T/n.")

YIELDING = Case(
    "4", "yielding_interface", "Wave through a yielding interface", "decks/verification/yielding_interface.lua",
    "A tension step of 200 MPa meets an interface that yields at 120 MPa, without hardening and with 5 MPa/um.",
    "without hardening the yield stress is transmitted, and the interface opens at 2 (s - yield)/(rho c); with h the stress is "
    "s - (s - yield) exp(-2 h t/(rho c)).",
    "n", of_n(30, 60, 120, 240), [
        percent("perfect: stress", "transmitted stress, perfect, max", 0.5, plotted=False, fitted=False),
        percent("perfect: opening", "opening at the end, perfect"),
        percent("hardening: the same, rms", "transmitted stress, hardening, rms of the incident"),
        percent("hardening: opening", "opening at the end, hardening"),
    ], 1, compare=True, history="yielding_interface", note="dt = 0.5 h/c. The remaining error is at the wave front, which is smeared over a few cells.")

DAMPER = Case(
    "4b", "damper", "Damper", "decks/verification/damper.lua",
    "A step of stress goes through a damper between two equal bars; a block on a damper slows down.",
    "2 c/(2 c + rho c_P) of the stress gets through, 2/3 at c = rho c_P; t^2/c per area and time is dissipated; exp(-c A t/m).",
    "n", of_n(30, 60, 120, 240), [
        percent("wave: stress that gets through, error", "stress that gets through, mean", 0.2, fitted=False),
        percent("wave: stroke at the end", "stroke at the end"),
        percent("wave: energy dissipated", "energy dissipated"),
        percent("normal: velocity", "block, along the normal", 0.2, plotted=False, fitted=False),
        percent("tangent: velocity", "block, along a tangent", 0.2, plotted=False, fitted=False),
    ], 1, compare=True, note="dt = 0.5 h/c. The remaining error is at the wave front, which is smeared over a few cells. The block is one cell, so its error is that of dt.")

ROD = Case(
    "5", "rod_in_sleeve", "Prestressed rod in a sleeve", "decks/verification/rod_in_sleeve.lua",
    "A rod is tightened in a sleeve, loaded below and beyond separation, unloaded, and left alone for 200 time steps.",
    "springs: F = d/(1/k_r + 1/k_s); it carries F + P k_r/(k_r + k_s), beyond separation all of P, then F again.",
    "head stiffness (GPa)", [(f"{head}", {"head": f"{head}*GPa"}) for head in (2, 20, 200, 2000)], [
        Quantity("force tightened", "force tightened", "", 1e-6),
        Quantity("share of a pull below", "share of a pull below separation", "", 1e-6),
        Quantity("all of a pull beyond", "all of a pull beyond separation", "", 1e-6, fitted=False),
        Quantity("force after the pull", "force after the pull", "", 1e-6),
        Quantity("open area beyond", "open area beyond separation, of all", "", 1e-9, 1, "1", plotted=False, fitted=False),
        Quantity("velocity left alone", "velocity left alone, of wave speed x strain", "", 1e-6, fitted=False),
    ], 3, x=[20e6 / (head * 1e9) for head in (2, 20, 200, 2000)],
    note="The exact solution has rigid heads; the bars are exact on any mesh, so the remaining error is that of the heads, of first "
         "order in their compliance. Static tolerance 1e-12.")

SLIDING = Case(
    "6", "sliding_block", "Sliding block", "decks/verification/sliding_block.lua",
    "A block thrown along a rough wall stops; on an incline it stays below the angle of friction and slides above it.",
    "Coulomb: stops after v^2/(2 mu g), all kinetic energy goes into friction; slides g (sin - mu cos) t^2/2 beyond tan = mu.",
    "n", [(f"{n}", {"n": n, "dt": f"{2 / n}*us"}) for n in (1, 2, 4, 8)], [
        percent("thrown: distance", "stopping distance", fitted=False),
        percent("thrown: work of friction", "work of friction", fitted=False),
        percent("shallow: way", "distance on a shallow incline / that without friction", fitted=False),
        percent("steep: way", "distance on a steep incline", fitted=False),
    ], 1, note="dt = 2/n us. The block is elastic: on the shallow incline it leans over, on the steep one its sole "
    "sticks until the shear has come down, so these two errors do not decrease with the mesh.")

PATCH = Case(
    "7", "patch", "Patch tests", "decks/verification/patch.lua",
    "A constant stress (three pressures; with shear too) passes through two distorted blocks that are bonded or in closed "
    "contact, in a static step and at rest in a dynamic one; hexahedra, prisms and tetrahedra, 12 runs.",
    "the stress is the same everywhere, displacements are linear.",
    "tolerance", [(t, {"tolerance": t}) for t in ("1e-7", "1e-9", "1e-11", "1e-13")], [
        Quantity("largest error of all", "largest error of stress and displacement, 12 runs", "", 1e-10),
        Quantity("hex8_contact_shear, velocity", "velocity at rest of c x strain, hex8, contact and shear", "", 1e-10),
    ], 3, x=[1e-7, 1e-9, 1e-11, 1e-13])

BONDED = Case(
    "8", "bonded_is_monolithic", "Bonded is monolithic", "decks/verification/bonded_is_monolithic.lua",
    "A block cut into 2, 8 and 36 bonded pieces against the uncut one: a static step, then 40 steps of a pulse.",
    "the uncut body, at every instant and 27 nodes.",
    "tolerance", [(t, {"tolerance": t}) for t in ("1e-4", "1e-6", "1e-8", "1e-10")], [
        Quantity("1x1x2 pieces", "displacement, 2 pieces, max of the largest", "", 1e-6),
        Quantity("2x2x2 pieces", "displacement, 8 pieces", "", 1e-6),
        Quantity("3x3x4 pieces", "displacement, 36 pieces", "", 1e-6),
    ], 3, x=[1e-4, 1e-6, 1e-8, 1e-10])

SPECTRUM = Case(
    "10", "spectrum", "Shock response spectrum", "decks/verification/spectrum.lua",
    "The spectrum of a half-sine of 1 g and 11 ms, from a shaken base: Q = 10, 10 to 1000 Hz.",
    "the oscillator's response in closed form: 0.4052, 0.7831, 1.3615, 1.6483 g at 10, 20, 40, 80 Hz, 1.6516 g at 75 Hz.",
    "dt (ms)", [(f"{dt}", {"dt": f"{dt}*ms"}) for dt in (0.4, 0.2, 0.1, 0.05)], [
        percent("maximax over the spectrum", "maximax, largest error over 10 to 1000 Hz", 0.05,
                goal_text="0.05 % (four digits of the table)"),
    ], 3, x=[0.4, 0.2, 0.1, 0.05], history="spectrum")

PRELOAD = Case(
    "5b", "preload", "Preload by force", "decks/verification/preload.lua",
    "A rod is tightened in a sleeve to a force: half, full, zero and full again; by torque; with a rod that yields; with a gap to close.",
    "springs: the force asked for, and the shortening d = F (1/k_r + 1/k_s), plus the plastic opening, plus the gap.",
    "head stiffness (GPa)", [(f"{head}", {"head": f"{head}*GPa"}) for head in (2, 20, 200, 2000)], [
        Quantity("force asked for in step 4, error of F", "force, of that asked for", "", 1e-3, goal_text="0.001", plotted=False, fitted=False),
        Quantity("force through a rod that yields, error", "force through a rod that yields", "", 1e-3, goal_text="0.001", plotted=False, fitted=False),
        Quantity("force through a gap that closes, error", "force through a gap that closes", "", 1e-3, goal_text="0.001", plotted=False, fitted=False),
        Quantity("shortening found in step 4, error", "shortening found", "", 1e-6),
    ], 3, x=[20e6 / (head * 1e9) for head in (2, 20, 200, 2000)],
    note="The exact solution has rigid heads, which explains the error of the shortening. The force is found to the static tolerance, 1e-12.")

GOODMAN = Case(
    "12", "goodman", "Goodman's joint", "decks/verification/goodman.lua",
    "A bar pressed uniformly on a rough rigid ground, loaded back and forth with five growing amplitudes: it slides gradually from its end.",
    "Goodman and Klumpp: a cycle between -F and F loses 2/3 F^3 / (E A q), q the friction force per metre; the exponent of the loss is 3.",
    "n", of_n(50, 100, 200, 400), [
        percent("loss, largest error", "loss of a cycle, largest error of five", 1),
        percent("displacement, largest error", "displacement amplitude, largest error", 1, fitted=False),
        Quantity("exponent over the force (3)", "exponent of the loss over the force", "", 0.05, 3.0, "3 to 0.05", plotted=False, fitted=False),
    ], 2, note="m = 20 increments between two turning points: the trapezoid around the loop keeps part of the error, however fine the mesh.")

UNLIKE_PATCH = Case(
    "7b", "unlike_patch", "Patch tests across meshes that do not match", "decks/verification/unlike_patch.lua",
    "The same between hexahedra, prisms, tetrahedra and a box, each on another: bonded and in closed contact, with and without shear, 20 runs.",
    "the stress is the same everywhere, displacements are linear.",
    "tolerance", [(t, {"tolerance": t}) for t in ("1e-7", "1e-9", "1e-11", "1e-13")], [
        Quantity("largest error of all", "largest error of stress and displacement, 20 runs", "", 1e-10),
    ], 3, x=[1e-7, 1e-9, 1e-11, 1e-13])

PRESS_FIT = Case(
    "9a", "press_fit_rings", "Press fit of two rings", "decks/verification/press_fit_rings.lua",
    "A ring is pressed into another, with 6 n facets a quarter on 10 n where they meet.",
    "Lame, plane strain.",
    "n", [(f"{n}", {"n_inner": 6 * n, "n_outer": 10 * n, "n_radial": 4 * n}) for n in (1, 2, 4, 8)], [
        percent("mean pressure, error of Lame's", "mean pressure", 0.5),
        percent("oscillation of the pressure", "largest over mean pressure less one", 1),
        percent("rim, error of Lame's", "displacement of the rim"),
    ], 1)

HERTZ = Case(
    "9b", "hertz", "Hertz ball on a block", "decks/verification/hertz.lua",
    "A steel ball is pressed on a block; tetrahedra of order two, the block's 1.3 times as large as the ball's.",
    "half spaces: radius (3 F R/(4 E*))^(1/3), peak pressure 3 F/(2 pi a^2); radius from the second moment of the normal forces.",
    "n", of_n(3, 4, 6, 8), [
        percent("contact radius, error of Hertz's", "contact radius", 0.5),
        percent("peak pressure, error of Hertz's", "largest pressure", 2),
    ], 2, note="n cells on the radius a = R/20 of the contact.")

HERTZ_CYLINDER = Case(
    "9c", "hertz_cylinder", "Hertz cylinder on a block", "decks/verification/hertz_cylinder.lua",
    "A cylinder is pressed on a block in plane strain; linear hexahedra, the block's 1.3 times as large as the cylinder's.",
    "half spaces: half width sqrt(4 P R/(pi E*)), peak pressure 2 P/(pi a).",
    "n", of_n(6, 12, 24, 48), [
        percent("half width, error of Hertz's", "half width", 0.5),
        percent("peak pressure, error of Hertz's", "largest pressure", 2),
    ], 1, note="n cells on the half width a = R/20.")

MINDLIN = Case(
    "9d", "mindlin", "Mindlin ball under shear", "decks/verification/mindlin.lua",
    "The ball is moved aside under a constant approach: the contact slips from its edge inwards (Q = 0.56 mu P, nu = 0).",
    "stick radius c = a (1 - Q/(mu P))^(1/3), read from the second moment of the shear; Q and P as computed.",
    "n", of_n(3, 4, 6, 8), [
        percent("contact radius, error of Hertz's", "contact radius", 0.5),
        percent("stick radius, error of Cattaneo's", "stick radius", 1, fitted=False),
    ], 2, note="The theory is exact for nu = 0 alone: with nu = 0.3 slip is not quite along the shear.")

PIN = Case(
    "9e", "pin_in_hole", "Loose pin in its hole", "decks/verification/pin_in_hole.lua",
    "A pin with clearance is pulled against the rim of its hole, E dR/P = 1; n cells a quarter of the hole, 1.3 n of the pin.",
    "Persson: plane stress, infinite plate, pin loaded at its centre, one material, no friction.",
    "n", of_n(6, 10, 20, 40), [
        percent("half angle of contact, error of Persson's", "half angle of contact", 2),
        percent("peak pressure, error of Persson's", "largest pressure", 2, fitted=False),
    ], 2, note="The plate is held at 30 radii, the pin is pulled by its middle, 0.15 radii wide.")

FLANGES_APART = Case(
    "9f", "flanges_apart", "Bolted flanges meshed apart", "decks/verification/flanges_apart.lua",
    "The bolted flanges, graded to the edges, with cells of another size in each part (upper 3/4, bolt 5/8 of the lower's) and with a quarter of tetrahedra of "
    "order two (1 mm at the edges), against hexahedra node on node: tightened, then shocked.",
    "none: the matching meshes of the same deck. Their bolt force tends to 29.28 kN; they have 29.75, 29.56 and 29.51 kN, the tetrahedra 29.58 (29.32 with 0.5 mm).",
    "size (mm)", [(f"{h}", {"size": f"{h}*mm", "upper": f"{0.75 * h}*mm", "bolt": f"{0.625 * h}*mm"}) for h in (6, 4, 3)], [
        percent("apart, bolt force from the first", "bolt force, difference", 1, fitted=False),
        Quantity("apart, spectrum above from the first, mean", "spectrum above the joint, mean difference", "dB", 0.5, fitted=False),
        Quantity("apart, spectrum above from the first, largest", "spectrum above the joint, largest difference", "dB", 0.5, fitted=False),
        Quantity("apart, spectrum below from the first, mean", "spectrum below the joint, mean difference", "dB", None, fitted=False),
        percent("tetrahedra, bolt force from the first", "tetrahedra, bolt force, difference", 1, fitted=False),
        Quantity("tetrahedra, spectrum above from the first, largest", "tetrahedra, spectrum above the joint, largest difference", "dB", 0.5, fitted=False),
        Quantity("tetrahedra, spectrum below from the first, mean", "tetrahedra, spectrum below the joint, mean difference", "dB", None, fitted=False),
    ], 1, x=[6, 4, 3],
    note="Little passes the open joint: the spectrum below it is less certain than this difference, as the run itself reports.")

FLANGES_TIED = Case(
    "9g", "flanges_tied", "Tied flanges with graded tetrahedra", "decks/verification/flanges_apart.lua",
    "The same tied throughout and the bolt shortened by 0.06 mm: a quarter, tetrahedra of order two, each part meshed by itself, fine at the edges.",
    "29.82 kN, the limit of meshes of one body graded to 0.12 mm at the edges, by an independent program.",
    "size at the edges (mm)", [(f"{h}", {"tied": 1, "first": 3, "edge": f"{h}*mm"}) for h in (2, 1, 0.5)], [
        percent("tetrahedra, bolt force, error of the limit", "bolt force", 1, fitted=False),
    ], 2, x=[2, 1, 0.5],
    note="15,729, 25,956 and 53,112 degrees of freedom, some seconds each. Graded hexahedra of the whole flanges, node on node, have +0.9 % with 36,891 and +0.3 % with 147,447; "
         "of one size +4.4 % with 6,618 and with 39,579.")

CASES = [BOUNCING_BAR, TWO_BARS, UNEQUAL_BARS, YIELDING, DAMPER, ROD, PRELOAD, SLIDING, PATCH, UNLIKE_PATCH, BONDED, PRESS_FIT, HERTZ, HERTZ_CYLINDER, MINDLIN, PIN,
         FLANGES_APART, FLANGES_TIED,
         SPECTRUM, GOODMAN]

SERIES = {  # of decks/verification/orders.lua: name in its lines -> (name in tables, theory, sizes, what x is)
    "h_hex8": ("h, hexahedra", 2, [40, 80, 160, 320], "n"),
    "h_prism6": ("h, prisms", 2, [40, 80, 160, 320], "n"),
    "h_tet4": ("h, tetrahedra", 2, [40, 80, 160, 320], "n"),
    "dt_undamped": ("dt, no damping", 2, [30, 60, 120, 240], "steps"),
    "dt_damped_0.2": ("dt, numerical damping 0.2", 1, [120, 240, 480, 960], "steps"),
}


@dataclass
class Measured:
    """A case at all its sizes."""

    case: Case
    runs: list
    values: list                # by quantity, by size
    others: dict = field(default_factory=dict)  # {solver: value by quantity} at the size of the goals

    def at_goal(self, i_quantity):
        return self.values[i_quantity][self.case.goal_at]

    def order(self, i_quantity):
        """Slope of log error over log width, by least squares; None where nothing is to fit."""
        quantity, values = self.case.quantities[i_quantity], self.values[i_quantity]
        unit = 0.01 if quantity.unit == "%" else 1.0
        return fitted_order(self.case.widths(), [unit * (v - quantity.target) for v in values]) if quantity.fitted else None


def fitted_order(widths, errors):
    """Least squares in logarithms; None with fewer than three errors that are more than round-off."""
    points = [(math.log(x), math.log(abs(e))) for x, e in zip(widths, errors) if abs(e) > ROUND_OFF and math.isfinite(e)]
    if len(points) < 3:
        return None
    x, y = np.array(points).T
    return float(np.polyfit(x, y, 1)[0])


def numbers(run, case):
    """What the deck prints of each quantity; nan where it does not."""
    found = []
    for quantity in case.quantities:
        try:
            found.append(run.number(quantity.label))
        except KeyError:
            found.append(math.nan)
    return found


def measure(case, program, say):
    """Runs the case at every size, and where it asks for it with the other solvers."""
    runs, values = [], [[] for _ in case.quantities]
    for label, settings in case.sizes:
        say(f"  {case.name}: {case.knob} = {label}")
        run = program.run(case.deck, settings)
        if run.exit_code != 0:
            say(f"    exit code {run.exit_code}: {run.text.strip().splitlines()[-1:]}")
        runs.append(run)
        for of_quantity, value in zip(values, numbers(run, case)):
            of_quantity.append(value)
    others = {}
    for name, solver in program.solvers().items() if case.compare and program.takes_solver else []:
        say(f"  {case.name}: {name}")
        others[name] = numbers(program.run(case.deck, case.sizes[case.goal_at][1], solver), case)
    return Measured(case, runs, values, others)


def measure_orders(program, say):
    """Errors of each series of orders.lua and the fitted order: name -> (errors, order)."""
    say("  orders: h for hexahedra, prisms, tetrahedra; dt")
    run = program.run("decks/verification/orders.lua", {"sizes": 4, "fine_dt": 2000, "fine_n": 1280})
    found = {}
    for series, (_, _, sizes, _) in SERIES.items():
        lines = [line for line in run.text.splitlines() if line.startswith(series + " ")]
        errors = [float(word) for word in lines[0].split("errors")[1].split("order")[0].split()]
        found[series] = (errors, fitted_order([1 / n for n in sizes], errors))
    return run, found
