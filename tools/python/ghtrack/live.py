"""The tracker for live use: scan by scan, as the measurements come."""

import json

import numpy as np

from ghtrack import _tracker
from ghtrack._program import InputError
from ghtrack.table import Table

__all__ = ["Tracker"]


class Tracker:
    """Tracks what it is told, one scan after the other.

    Parameters
    ----------
    config : text or dict, as the file of `ghtrack track --config`, such as
        {"noise": 0.3, "tracker": {"filters": {"default": {"gh": {"g": 0.4, "h": 0.1}}}}}
    period : nominal time between scans [s], unless the configuration says it
    """

    def __init__(self, config=None, period=None):
        text = config if isinstance(config, str) else json.dumps(config or {}, indent=1)
        try:
            self._tracker = _tracker.LiveTracker(text, period)
        except ValueError as error:
            raise InputError(str(error)) from error

    def step(self, t, xy, covariance=None, labels=()):
        """Processes the detections of one instant and returns all tracks.

        Parameters
        ----------
        t : time of the scan [s]; a scan older than the last one is refused with a ValueError
        xy : (n, 2) positions [m], none is an empty list
        covariance : (n, 2, 2) of each position [m²], or (2, 2) of all, instead of the noise
        labels : class of each detection, if the sensor says one

        Returns a Table with the columns of tracks.csv.
        """
        xy = np.asarray(xy, dtype=float).reshape(-1, 2)
        if covariance is None or not len(xy):
            covariance = np.empty(0)
        else:
            covariance = np.broadcast_to(np.asarray(covariance, dtype=float), (len(xy), 2, 2))
        if not self._tracker.step(float(t), xy, covariance, [str(label) for label in labels]):
            raise InputError(f"the scan at {t} s is not later than the one before it")
        return self.tracks

    @property
    def tracks(self):
        """All tracks as they are after the last scan."""
        return Table(self._tracker.tracks())
