"""Fading memory: least squares that forget old measurements as beta^age."""

import numpy as np

from ghtrack import _filters
from ghtrack._recurrence import corrected, described, predicted

__all__ = ["FadingMemoryFilter"]


class FadingMemoryFilter:
    """Fading-memory polynomial filter of order 0, 1 or 2 (Zarchan & Musoff; Morrison).

    Parameters
    ----------
    x0 : initial state, a number or an array (order + 1, …) with the derivatives
    dt : time between measurements
    order : degree of the polynomial
    beta : in [0, 1); 0 follows the measurements, 1 would ignore them

    Attributes
    ----------
    x : array (order + 1, …) of the state and its derivatives
    P : steady variances of x in units of the measurement's
    e : steady errors while the truth follows t^(order + 1), per unit of its coefficient
    """

    def __init__(self, x0, dt, order, beta):
        if order not in (0, 1, 2):
            raise ValueError("order must be between 0 and 2")
        if not 0.0 <= beta < 1.0:
            raise ValueError("beta must lie in [0, 1)")
        if np.ndim(x0) == 0:
            self.x = np.zeros(order + 1)
            self.x[0] = x0
        else:
            self.x = np.array(x0, dtype=float)
        self.dt, self.order, self.beta = dt, order, beta
        self.P = np.array(_filters.fading_memory_variance(order, beta, dt)[: order + 1])
        self.e = np.array(_filters.fading_memory_truncation_error(order, beta, dt)[: order + 1])

    def update(self, z):
        """Predicts by one step and corrects with the measurement z."""
        state = np.zeros((3,) + self.x.shape[1:])
        state[: self.order + 1] = self.x
        x, dx = predicted(*state, self.dt)
        gains = _filters.fading_memory(self.order, self.beta)
        state[:] = corrected(x, dx, state[2], np.subtract(z, x), self.dt, *gains)
        self.x = state[: self.order + 1]

    def __repr__(self):
        return described(self, "dt", "order", "beta", "x", "P", "e")
