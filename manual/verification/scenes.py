"""The scenes of speed against error: what runs, which knobs, and the error that a user would look at."""

from dataclasses import dataclass, field

import numpy as np

import histories

TOLERANCES = ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8"]
WINDOWS = ["1", "5", "20"]
N_INSTANTS = 20001


@dataclass
class Scene:
    """A deck, its knobs and its two errors.

    `mesh` and `dt` are lists of (value shown, settings); `base` are the settings of the other knobs. `errors(run, reference)`
    answers two relative errors; `reference` is None where the solution is exact, else the Run of (deck, reference settings).
    """

    name: str
    title: str
    deck: str
    mesh: list
    dt: list
    base: dict
    errors: object
    quantities: tuple
    exact: bool
    why: str            # the mechanism behind who wins
    reference: list = field(default_factory=list)       # settings, finest first, then the one before it
    quick_reference: list = field(default_factory=list)
    solvers: tuple = ()  # names of those that are tried, by mesh and dt alone; none: all that the program has, by every knob


def relative_l2(t, computed, exact):
    """Relative L2 norm of the difference in time, on even instants."""
    return float(np.sqrt(np.mean((computed - exact) ** 2) / np.mean(exact**2)))


def sampled(table, column, t):
    """A column at instants t, linear between rows; the rows of dynamic steps only, since static time stands still."""
    moving = np.concatenate([[True], np.diff(table["time"]) > 0])
    moving[:-1] &= np.diff(table["time"]) > 0
    return np.interp(t, table["time"][moving], table[column][moving])


def bouncing_bar(run, _):
    t = np.linspace(0, 16 / 3, N_INSTANTS)
    pressure, place = (np.array([f(s) for s in t]) for f in (histories.bar_pressure, histories.bar_place))
    push, lower = run.table("push"), run.table("lower_end")
    return (relative_l2(t, sampled(push, "normal", t * 1e-4) / -0.1, pressure),
            relative_l2(t, 5 + sampled(lower, "displacement", t * 1e-4) / 1e-3, place))


def two_bars(run, _):
    t = np.linspace(0, 3e-6, N_INSTANTS)
    stress = sampled(run.table("push"), "normal", t) / 1e-8
    exact = np.where(t < 2e-6, -100e6, 0.0)
    inside = (t > 0.1e-6) & (t < 1.9e-6)
    return relative_l2(t[inside], stress[inside], exact[inside]), relative_l2(t, stress, exact)


def yielding_beam(run, _):
    t, hardening = np.linspace(0, 24e-6, N_INSTANTS), 5e12
    exact = histories.yielding_stress(t, 10e-6, hardening)
    opening = np.where(t < 10e-6, 0.0, (exact - 120e6) / hardening)
    stress = sampled(run.table("through"), "normal", t) / 25e-6
    return relative_l2(t, stress, exact), relative_l2(t, sampled(run.table("yielding"), "plastic_opening", t), opening)


def crush(run, reference):
    t = np.linspace(0, 60e-6, N_INSTANTS)
    return tuple(relative_l2(t, sampled(run.table(output), column, t), sampled(reference.table(output), column, t))
                 for output, column in (("spread", "displacement"), ("grip", "normal")))


def bolted_flanges(run, reference):
    t = np.linspace(0, 200e-6, N_INSTANTS)
    force = [sampled(r.table("bolt"), "normal", t) for r in (run, reference)]
    spectra = [np.interp(np.geomspace(5e3, 1e5, 200), r.table("srs_above")["frequency"], r.table("srs_above")["maximax"])
               for r in (run, reference)]
    return relative_l2(t, *force), relative_l2(None, *spectra)


def electronics_box(run, reference):
    """Spectrum of the boards, and the force through the feet in the shock."""
    spectra = [np.interp(np.geomspace(5e2, 1e4, 200), r.table("boards_srs")["frequency"], r.table("boards_srs")["maximax"])
               for r in (run, reference)]
    t = np.linspace(0, 200e-6, N_INSTANTS)
    return relative_l2(None, *spectra), relative_l2(t, *(sampled(r.table("feet"), "normal", t) for r in (run, reference)))


def of_box(dt):
    return {"size": "20*mm", "pulse": "0.1*ms", "duration": "0.2*ms", "dt": f"{dt}*us"}


def of_cfl(values):
    return [(f"{cfl}", {"n": 100, "cfl": cfl}) for cfl in values]


SCENES = [
    Scene("bouncing_bar", "Bouncing bar", "decks/verification/bouncing_bar.lua",
          [(f"{n}", {"n": n}) for n in (25, 50, 100, 200, 400)], of_cfl((4, 2, 1, 0.5, 0.25)), {"n": 100},
          bouncing_bar, ("contact pressure", "place of the lower end"), True,
          "The contact has four nodes, so the waves dominate the cost; an explicit increment of latin, whose contact is exact, needs neither a solve nor a penalty. "
          "The bar flies towards the wall, so its mass is tuned (eq. S15), which brings 1 % at a sixth of the cost of lumped mass. "
          "In L2 a jump of the pressure that is late or smeared costs the square root of its width, so only the mesh reduces this error."),
    Scene("two_bars", "Two bars", "decks/verification/two_bars.lua",
          [(f"{n}", {"n": n}) for n in (25, 50, 100, 200, 400)], of_cfl((4, 2, 1, 0.5, 0.25)), {"n": 100},
          two_bars, ("contact stress, but 5 % at each end", "contact stress with impact and release"), True,
          "The contact has four nodes, so the waves dominate the cost; an explicit increment of latin, whose contact is exact, needs neither a solve nor a penalty. "
          "Bars that meet at speed have their mass tuned, which pays at every level. "
          "With impact and release in the norm, the square root of their widths dominates."),
    Scene("yielding_beam", "Yielding beam", "decks/plastic_beam.lua",
          [(f"{n}", {"n": n, "dt": f"{0.1 / n}*us", "hardening": "5*MPa/um"}) for n in (1, 2, 3, 4)],
          [(f"{dt}", {"n": 2, "dt": f"{dt}*us", "hardening": "5*MPa/um"}) for dt in (0.4, 0.2, 0.1, 0.05, 0.025)],
          {"n": 2, "dt": "0.05*us", "hardening": "5*MPa/um"}, yielding_beam, ("stress that gets through", "plastic opening"), True,
          "Few interface unknowns again: the cost is in the solves of the bodies, which an explicit step does not need. The error is at the front, "
          "which is smeared over some cells; a tuned mass keeps it sharper: that pays from 3 % on in the stress and from 1 % on in the opening; at coarser levels, where the coarsest mesh will do, "
          "lumped mass would save a quarter of a few milliseconds."),
    Scene("crush", "Crush", "decks/crush.lua",
          [(f"{n}", {"n": n, "dt": f"{1.2 / n}*us"}) for n in (2, 4, 6, 8, 12)],
          [(f"{dt}", {"n": 8, "dt": f"{dt}*us"}) for dt in (1.2, 0.6, 0.3, 0.15, 0.075)], {"n": 8, "dt": "0.15*us"},
          crush, ("spread of the corner", "contact force"), False,
          "The corner is singular: the spread converges slowly with the mesh, and dt hardly matters. There the give of a penalty makes up for coarse cells, and solver.explicit is the "
          "cheapest; its 3 % is little more than what the reference itself is off by. In the contact force, which is smooth, latin's exact contact and tuned mass are. The reference has the "
          "contact and the lumped masses of latin and monolithic: errors of these do not show.",
          [{"n": 20, "dt": "0.06*us"}, {"n": 16, "dt": "0.075*us"}], [{"n": 12, "dt": "0.1*us"}, {"n": 8, "dt": "0.15*us"}]),
    Scene("bolted_flanges", "Bolted flanges", "decks/bench/even_flanges.lua",
          [(f"{size}", {"size": f"{size}*mm", "dt": f"{dt}*us"}) for size, dt in ((5, 1.25), (4, 1), (3, 0.8), (2.5, 0.625), (2, 0.5))],
          [(f"{dt}", {"dt": f"{dt}*us"}) for dt in (4, 2, 1, 0.5, 0.25)], {},
          bolted_flanges, ("bolt force", "spectrum above the joint, from 5 kHz"), False,
          "Five bodies with large joints: separately, their factors are far smaller than that of the assembly, and the dense matrix of the "
          "joints, which the monolithic solver factorises again and again, is replaced by products with each body's own operator. What the pulse brings leaves lumped mass "
          "late by less than a tenth of a radian, so the program does not tune it, and is right. Only the implicit solvers come to 0.3 % of the spectrum: the reference, itself off by 0.2 %, has their "
          "time scheme and mass.",
          [{"size": "1.75*mm", "dt": "0.25*us"}, {"size": "2*mm", "dt": "0.25*us"}],
          [{"size": "2.5*mm", "dt": "0.5*us"}, {"size": "3*mm", "dt": "0.5*us"}]),
    Scene("electronics_box", "Electronics box", "decks/electronics_box.lua",
          [("20", of_box(5))], [(f"{dt}", of_box(dt)) for dt in (10, 5, 2.5)], of_box(5),
          electronics_box, ("spectrum on the boards", "force through the feet"), False,
          "Four bolts are tightened one after the other before a shock of 0.2 ms: the static steps are nearly all of the cost, and are the same whatever integrates the shock. "
          "One mesh of tetrahedra of order two, so errors are those of time alone, but for explicit increments, whose diagonal mass is another model of the "
          "same mesh. solver.explicit and tuned masses are for cells of order one.",
          [of_box(1.25), of_box(2.5)], [of_box(5), of_box(10)], ("latin", "latin implicit", "latin explicit lumped", "monolithic")),
]
