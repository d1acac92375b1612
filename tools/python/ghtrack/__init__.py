"""ghtrack: simulate moving objects, sense them badly, track them with g-h filters.

Filters by themselves:  ghtrack.gh, ghtrack.leastsq, ghtrack.memory, ghtrack.kalman,
ghtrack.discrete_bayes, ghtrack.stats, ghtrack.common; their names are those of FilterPy.

Parts are loaded when they are first used, so that importing this costs next to nothing.
"""

import importlib

_SUBMODULES = ("common", "discrete_bayes", "gh", "kalman", "leastsq", "memory", "stats")

__all__ = list(_SUBMODULES)


def __getattr__(name):
    if name in _SUBMODULES:
        return importlib.import_module(f"ghtrack.{name}")
    raise AttributeError(f"module 'ghtrack' has no attribute {name!r}")


def __dir__():
    return sorted(list(globals()) + list(_SUBMODULES))
