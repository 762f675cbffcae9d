"""Histories of loads: as Lua, and their means over a time step, which is what the program takes of the named ones."""

import math


def lua(history, value, number):
    """The text of value * history; number writes a number."""
    shape = history["shape"]
    if shape in ("half_sine", "haversine"):
        return f"history.{shape}{{ peak = {number(value)}, duration = {number(history['duration'])} }}"
    if shape == "ramp":
        return f"history.ramp{{ to = {number(value)}, duration = {number(history['duration'])} }}"
    if shape == "step":
        return f"history.step{{ value = {number(value)}, at = {number(history['at'])} }}"
    if shape == "pulse":
        return f"history.pulse{{ peak = {number(value)}, rise = {number(history['rise'])}, hold = {number(history['hold'])}, fall = {number(history['fall'])} }}"
    times = ", ".join(number(t) for t in history["times"])
    values = ", ".join(number(value * v) for v in history["values"])
    return f"history.piecewise{{ times = {{ {times} }}, values = {{ {values} }} }}"


def corners(history):
    """Points between which it is straight, for those made of straight lines; constant outside."""
    shape = history["shape"]
    if shape == "ramp":
        return [0.0, history["duration"]], [0.0, 1.0]
    if shape == "pulse":
        rise, hold, fall = history["rise"], history["hold"], history["fall"]
        return [0.0, rise, rise + hold, rise + hold + fall], [0.0, 1.0, 1.0, 0.0]
    return history["times"], history["values"]


def integral(history, t):
    """From 0 to t, of a history of peak 1."""
    shape = history["shape"]
    if t <= 0:
        return 0.0
    if shape == "half_sine":
        d = history["duration"]
        return d / math.pi * (1 - math.cos(math.pi * min(t, d) / d))
    if shape == "haversine":
        d = history["duration"]
        t = min(t, d)
        return t / 2 - d / (4 * math.pi) * math.sin(2 * math.pi * t / d)
    if shape == "step":
        return max(0.0, t - history["at"])
    times, values = corners(history)
    total = 0.0
    for t0, t1, v0, v1 in zip(times, times[1:], values, values[1:]):
        if t <= t0:
            break
        end = min(t, t1)
        v_end = v0 + (v1 - v0) * (end - t0) / (t1 - t0)
        total += (end - t0) * (v0 + v_end) / 2
    return total + max(0.0, t - times[-1]) * values[-1]


def mean(history, t0, t1):
    """Over a time step; a plain number acts in full."""
    return 1.0 if history is None else (integral(history, t1) - integral(history, t0)) / (t1 - t0)
