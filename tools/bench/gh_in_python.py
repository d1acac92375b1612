#!/usr/bin/env python3
"""What a g-h update costs in Python: the recurrence of FilterPy's GHFilter, for one object on two
axes, with plain numbers and, where numpy is installed, with arrays.

    tools/bench/gh_in_python.py [SECONDS]      time spent on each line, default 1
"""

import random
import sys
import timeit

try:
    import numpy
except ImportError:
    numpy = None

DT = 0.1


class GhFilter:
    """x and dx are numbers or arrays, whatever z is."""

    def __init__(self, x, dx, g=0.4, h=0.1):
        self.x, self.dx, self.g, self.h = x, dx, g, h

    def update(self, z):
        predicted = self.x + self.dx * DT
        residual = z - predicted
        self.dx = self.dx + self.h * residual / DT
        self.x = predicted + self.g * residual


def report(name, update, objects_per_call, seconds):
    calls, elapsed = timeit.Timer(update).autorange()
    repeats = max(1, round(seconds / elapsed))
    best = min(timeit.repeat(update, number=calls, repeat=repeats)) / (calls * objects_per_call)
    print(f"{name:34} {best * 1e9:12.2f} ns/update {1 / best:14.4g} updates/s")


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    random.seed(1)

    x_axis, y_axis = GhFilter(0.0, 0.0), GhFilter(0.0, 0.0)
    z = random.uniform(-100, 100), random.uniform(-100, 100)

    def both_axes():
        x_axis.update(z[0])
        y_axis.update(z[1])

    report("plain Python, one object", both_axes, 1, seconds)
    if numpy is None:
        print("numpy is not installed: no arrays")
        return
    for objects in (1, 1_000, 100_000, 1_000_000):
        measured = numpy.random.default_rng(1).uniform(-100, 100, 2 * objects)
        batch = GhFilter(numpy.zeros(2 * objects), numpy.zeros(2 * objects))
        report(f"numpy, {objects} objects", lambda: batch.update(measured), objects, seconds)


if __name__ == "__main__":
    main()
