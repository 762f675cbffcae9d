#!/usr/bin/env python3
"""A shock such as a drop tower or a pyroshock plate gives: decaying sines, own figures, no test's.

    python3 decks/records/make_synthetic_shock.py > decks/records/synthetic_shock.csv
"""
import math

SINES = ((400.0, 120.0, 0.06), (900.0, 250.0, 0.05), (1600.0, 400.0, 0.05), (2700.0, 500.0, 0.06), (4500.0, 600.0, 0.08))  # Hz, g, of critical
STEP, LENGTH, RISE, FALL = 10e-6, 12e-3, 0.2e-3, 3e-3  # s

print("time (s);acceleration (g)")
for i in range(int(round(LENGTH / STEP)) + 1):
    t = i * STEP
    window = min(1.0, t / RISE, (LENGTH - t) / FALL)
    value = sum(g * math.exp(-ratio * 2 * math.pi * f * t) * math.sin(2 * math.pi * f * t) for f, g, ratio in SINES)
    print(f"{t:.5f};{window * value:.4f}")
