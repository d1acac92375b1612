"""ghtrack: simulate moving objects, sense them badly, track them with g-h filters.

    run = ghtrack.run("scenes/three_regimes.yaml", seed=3)
    run.truth.x, run.tracks.x, run.metrics["total"]
    ghtrack.track(detections, config={"noise": 0.5})
    ghtrack.Tracker(period=0.1).step(t, xy)

Filters by themselves are in ghtrack.gh, ghtrack.leastsq, ghtrack.memory, ghtrack.kalman,
ghtrack.discrete_bayes, ghtrack.stats and ghtrack.common; their names are those of FilterPy.

Parts are loaded when they are first used, so that importing this costs next to nothing.
"""

import importlib

_MODULES = ("common", "discrete_bayes", "gh", "kalman", "leastsq", "memory", "stats")
_NAMES = {
    "EnvironmentFailure": "_program",
    "InputError": "_program",
    "Table": "table",
    "Tracker": "live",
    **dict.fromkeys(
        ("compare", "gains", "load_scene", "plot", "render", "run", "score", "track", "tune", "view"), "experiment"
    ),
}

__all__ = sorted([*_MODULES, *_NAMES])


def __getattr__(name):
    if name in _MODULES:
        return importlib.import_module(f"ghtrack.{name}")
    if name in _NAMES:
        value = getattr(importlib.import_module(f"ghtrack.{_NAMES[name]}"), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module 'ghtrack' has no attribute {name!r}")


def __dir__():
    return sorted([*globals(), *__all__])
