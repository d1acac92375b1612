from ghtrack import common as common
from ghtrack import discrete_bayes as discrete_bayes
from ghtrack import gh as gh
from ghtrack import kalman as kalman
from ghtrack import leastsq as leastsq
from ghtrack import memory as memory
from ghtrack import stats as stats
from ghtrack._program import EnvironmentFailure as EnvironmentFailure
from ghtrack._program import InputError as InputError
from ghtrack.experiment import compare as compare
from ghtrack.experiment import gains as gains
from ghtrack.experiment import load_scene as load_scene
from ghtrack.experiment import plot as plot
from ghtrack.experiment import render as render
from ghtrack.experiment import run as run
from ghtrack.experiment import score as score
from ghtrack.experiment import track as track
from ghtrack.experiment import tune as tune
from ghtrack.experiment import view as view
from ghtrack.live import Tracker as Tracker
from ghtrack.table import Table as Table

__all__ = [
    "EnvironmentFailure", "InputError", "Table", "Tracker", "common", "compare", "discrete_bayes", "gains",
    "gh", "kalman", "leastsq", "load_scene", "memory", "plot", "render", "run", "score", "stats", "track", "tune",
    "view",
]

def __getattr__(name: str) -> object: ...
def __dir__() -> list[str]: ...
