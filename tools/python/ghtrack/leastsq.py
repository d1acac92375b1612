"""Growing memory: the least-squares polynomial through all measurements so far."""

import numpy as np

from ghtrack import _filters
from ghtrack._recurrence import corrected, described, predicted

__all__ = ["LeastSquaresFilter"]


class LeastSquaresFilter:
    """Recursive least squares of order 0, 1 or 2 (Zarchan & Musoff).

    Parameters
    ----------
    dt : time between measurements
    order : degree of the polynomial
    noise_sigma : 1-sigma error of a measurement, for errors() only

    Attributes
    ----------
    n : measurements so far
    x : array (order + 1) of the estimate and its derivatives
    K : gains of the last update, such that x += K y
    y : residual of the last update
    """

    def __init__(self, dt, order, noise_sigma=0.0):
        if order not in (0, 1, 2):
            raise ValueError("order must be between 0 and 2")
        self.dt, self.sigma, self._order = dt, noise_sigma, order
        self.reset()

    def reset(self):
        """Forgets all measurements."""
        self.n = 0
        self.x = np.zeros(self._order + 1)
        self.K = np.zeros(self._order + 1)
        self.y = 0.0

    def update(self, z):
        """Takes one more measurement and returns the new x."""
        self.n += 1
        g, h, k = _filters.growing_memory(self._order, self.n)
        dt = self.dt
        self.K = np.array([g, h / dt, 2.0 * k / (dt * dt)])[: self._order + 1]
        state = list(self.x) + [0.0] * (2 - self._order)
        x, dx = predicted(*state, dt)
        self.y = z - x
        self.x = np.array(corrected(x, dx, state[2], self.y, dt, g, h, k)[: self._order + 1])
        return self.x.copy()

    def errors(self):
        """1-sigma errors of x, and the same again, as FilterPy has them.

        Both are infinite where so few measurements do not determine a derivative, zero before the
        first one.
        """
        if self.n == 0:
            return np.zeros(self._order + 1), np.zeros(self._order + 1)
        sigma = _filters.growing_memory_sigma(self._order, self.n, self.sigma, self.dt)
        error = np.array(sigma[: self._order + 1])
        return error, error.copy()

    def __repr__(self):
        return described(self, "dt", "sigma", "_order", "n", "x", "K", "y")
