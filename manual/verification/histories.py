"""Computed histories over the exact ones, drawn from the tables of a run at the size of the goals."""

import math

import numpy as np

from figures import over_exact


def panels(n):
    def mark(function):
        function.panels = n
        return function
    return mark


def bar_place(t):
    """Place of the bouncing bar's lower end; units of 1 mm and 0.1 ms (Doyen, Ern, Piperno 2011)."""
    transit, g, drop = 2 / 3, 10, 5
    if t < 1:
        return drop - g * t**2 / 2
    if t < 1 + transit or 11 / 3 <= t < 11 / 3 + transit:
        return 0.0
    if t < 11 / 3:
        tau = t - 1 - transit
        phase = tau % transit
        return 10 * tau - g * tau**2 / 2 + 10 * phase * (phase - transit)
    tau = t - 11 / 3 - transit
    return 10 * tau - g * tau**2 / 2


def bar_pressure(t):
    """Its contact pressure, in units of 0.1 MPa."""
    transit = 2 / 3
    if 1 <= t < 1 + transit:
        return 300 + 200 * (t - 1) / transit
    if 11 / 3 <= t < 11 / 3 + transit:
        return 500 - 200 * (t - 11 / 3) / transit
    return 0.0


@panels(2)
def bouncing_bar(axes, measured):
    run = measured.runs[measured.case.goal_at]
    lower, push = run.table("lower_end"), run.table("push")
    t = np.linspace(0, 16 / 3, 1600)
    over_exact(axes[0], t, [bar_place(s) for s in t], lower["time"] / 1e-4, 5 + lower["displacement"] / 1e-3)
    over_exact(axes[1], t, [bar_pressure(s) for s in t], push["time"] / 1e-4, -push["normal"] / 1e-6 / 1e5)
    axes[0].set_title("place of the lower end (mm), n = 100")
    axes[1].set_title("contact pressure (0.1 MPa)")
    for a in axes:
        a.set_xlabel("time (0.1 ms)")
    axes[1].legend(loc="center")


@panels(1)
def two_bars(axes, measured):
    push = measured.runs[measured.case.goal_at].table("push")
    t = np.linspace(0, 3, 1200)
    over_exact(axes[0], t, np.where(t < 2, -100, 0), push["time"] / 1e-6, push["normal"] / 1e-8 / 1e6)
    axes[0].set_title("contact stress (MPa), n = 100")
    axes[0].set_xlabel("time (us)")
    axes[0].legend(loc="upper left")


@panels(1)
def unequal_bars(axes, measured):
    push = measured.runs[measured.case.goal_at].table("push")
    t, area, first = np.linspace(0, 7, 1400), 25e-6, -20 * 2 / 3 * math.sqrt(3125 * 20e9) / 1e6
    exact = first * np.select([t < 2, t < 4, t < 5], [1, 1 / 3, 1 / 9], 0)
    over_exact(axes[0], t, exact, push["time"] / 1e-5, push["normal"] / area / 1e6)
    axes[0].set_title("contact stress (MPa), n = 40 cells a T")
    axes[0].set_xlabel("time / T")
    axes[0].legend(loc="upper left")


def yielding_stress(t, arrival, hardening, incident=200e6, yields=120e6, impedance=4e7):
    """Stress through the yielding interface, t and arrival in s, hardening in Pa/m."""
    after = np.maximum(np.asarray(t) - arrival, 0)
    stress = incident - (incident - yields) * np.exp(-2 * hardening / impedance * after)
    return np.where(np.asarray(t) < arrival, 0.0, stress)


@panels(1)
def yielding_interface(axes, measured):
    run, t = measured.runs[measured.case.goal_at], np.linspace(0, 30e-6, 1500)
    for case, hardening, x, y in (("perfect", 0, 30, 112), ("hardening", 5e12, 26, 175)):
        through = run.table("through", case)
        over_exact(axes[0], t * 1e6, yielding_stress(t, 10e-6, hardening) / 1e6, through["time"] * 1e6, through["normal"] / 25e-6 / 1e6,
                   "computed")
        axes[0].text(x, y, case, ha="right", va="top")
    axes[0].set_title("stress that gets through (MPa), n = 60")
    axes[0].set_xlabel("time (us)")
    axes[0].legend(*[part[:2] for part in axes[0].get_legend_handles_labels()], loc="upper left")


def half_sine_maximax(f, duration=0.011, q_factor=10):
    """Largest absolute acceleration of the oscillator of frequency f (Hz) under a half-sine of 1, in closed form."""
    wn, w, zeta = 2 * math.pi * f, math.pi / duration, 1 / (2 * q_factor)
    wd = wn * math.sqrt(1 - zeta**2)
    a, b = np.linalg.solve([[wn**2 - w**2, -2 * zeta * wn * w], [2 * zeta * wn * w, wn**2 - w**2]], [-1, 0])

    def free(r, v, t):
        s, decay = (v + zeta * wn * r) / wd, np.exp(-zeta * wn * t)
        co, si = np.cos(wd * t), np.sin(wd * t)
        x = decay * (r * co + s * si)
        return x, decay * ((s * wd - zeta * wn * r) * co - (r * wd + zeta * wn * s) * si)

    def forced(t):
        x, v = free(-b, -a * w, t)
        return x + a * np.sin(w * t) + b * np.cos(w * t), v + a * w * np.cos(w * t) - b * w * np.sin(w * t)

    during, after = forced(np.linspace(0, duration, 2001)), free(*forced(duration), np.linspace(0, 1 / f, 2001))
    return max(np.max(np.abs(2 * zeta * wn * v + wn**2 * x)) for x, v in (during, after))


@panels(1)
def spectrum(axes, measured):
    srs = measured.runs[measured.case.goal_at].table("srs")
    f = np.geomspace(10, 1000, 300)
    axes[0].semilogx(f, [half_sine_maximax(value) for value in f], color="#999999", linewidth=4, alpha=0.55, label="exact")
    axes[0].semilogx(srs["frequency"], srs["maximax"] / 9.80665, "o", markersize=3, color="#0b5394", label="computed")
    axes[0].set_title("maximax (g), dt = 0.05 ms")
    axes[0].set_xlabel("frequency (Hz)")
    axes[0].legend(loc="lower right")
