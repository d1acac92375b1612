"""g-h and g-h-k filters and the rules that choose their gains.

The classes and functions are those that users of FilterPy's module of this name know, with the
same names, arguments and attributes. They differ where that one is wrong: variances of the g-h-k
filter are right, its `batch_filter` uses the acceleration, vector states can be filtered in a
batch, and `z` is kept.

The third gain is FilterPy's and Brookner's everywhere: ddx += 2 k r / dt².
"""

import numpy as np

from ghtrack import _filters
from ghtrack._recurrence import corrected, described, predicted

__all__ = [
    "GHFilter",
    "GHKFilter",
    "GHFilterOrder",
    "benedict_bordner_constants",
    "critical_damping_parameters",
    "least_squares_parameters",
    "optimal_noise_smoothing",
]


def _chosen(override, own):
    return own if override is None else override


def _measurements(data):
    """The data as an array, a row a measurement; None and masked entries become NaN: missing."""
    if isinstance(data, np.ma.MaskedArray):
        return data.astype(float).filled(np.nan)
    return np.asarray(data, dtype=float)


def _batch(owner, order, data, state, gains, save_predictions, saver):
    """All estimates, the initial one first, and the prediction of each measurement if wanted."""
    z = _measurements(data)
    shape = np.broadcast_shapes(np.shape(state[0]), np.shape(state[1]), z.shape[1:])
    count = len(z)

    if z.shape != (count,) + shape:
        z = np.broadcast_to(z.reshape((count,) + (1,) * len(shape)) if z.ndim == 1 else z, (count,) + shape)
    start = np.stack([np.broadcast_to(np.asarray(value, dtype=float), shape) for value in state])
    gains = [np.asarray(gain, dtype=float) for gain in gains]
    if any(gain.ndim > 1 or gain.size not in (1, count) for gain in gains):
        raise ValueError(f"a gain is one number or one for each of the {count} measurements")
    estimates, predictions = _filters.batch(
        order,
        z.reshape(count, -1) if count else z.reshape(0, start[0].size),
        start.reshape(order + 1, -1),
        owner.dt,
        *gains,
        save_predictions or saver is not None,
    )
    estimates = estimates.reshape((count + 1, order + 1) + shape)
    if predictions is not None:
        predictions = predictions.reshape((count,) + shape)
    if saver is not None:
        _save_each(owner, saver, z, estimates, predictions)
    return (estimates, predictions) if save_predictions else estimates


def _save_each(owner, saver, z, estimates, predictions):
    """Lets a Saver see each step: the filter holds it for a moment, and its own state after it."""
    names = ("x", "dx", "ddx")[: estimates.shape[1]]
    before = dict(owner.__dict__)
    for step, (measured, prediction) in enumerate(zip(z, predictions), start=1):
        for name, value in zip(names, estimates[step]):
            setattr(owner, name, value)
        owner.z, owner.x_prediction, owner.y = measured, prediction, measured - prediction
        saver.save()
    owner.__dict__.update(before)


class GHFilter:
    """The g-h filter: position and velocity with constant gains.

    Parameters
    ----------
    x, dx : float or array
        Initial state and its rate; an array holds independent variables.
    dt : float
        Time between updates.
    g, h : float
        Gains of the state and of its rate.

    Attributes
    ----------
    x, dx : estimate after the last update
    x_prediction, dx_prediction : the same before it
    y : residual z − x_prediction
    z : the last measurement
    dt, g, h : as given; may be changed between updates
    """

    def __init__(self, x, dx, dt, g, h):
        self.x, self.dx = x, dx
        self.x_prediction, self.dx_prediction = x, dx
        self.dt, self.g, self.h = dt, g, h
        self.y = self.z = np.zeros(np.shape(x)) if np.ndim(x) else 0.0

    def update(self, z, g=None, h=None):
        """Predicts by one step and corrects with the measurement z; g and h hold for this once.

        Returns (x, dx).
        """
        g, h = _chosen(g, self.g), _chosen(h, self.h)
        self.x_prediction, self.dx_prediction = predicted(self.x, self.dx, 0.0, self.dt)
        self.z = z
        self.y = np.subtract(z, self.x_prediction)
        self.x, self.dx, _ = corrected(
            self.x_prediction, self.dx_prediction, 0.0, self.y, self.dt, g, h, 0.0
        )
        return self.x, self.dx

    def batch_filter(self, data, save_predictions=False, saver=None, g=None, h=None):
        """Filters a series from the current state, which it leaves as it is.

        Parameters
        ----------
        data : n measurements, each like x; NaN or None is a missed one: the row is predicted only
        save_predictions : whether to return the predictions, too
        saver : a Saver of this filter, told after each step
        g, h : a gain, or one for each measurement, instead of the filter's own

        Returns
        -------
        results : array (n + 1, 2) of x and dx, the initial state first; (n + 1, 2, …) for vectors
        predictions : array (n, …), with save_predictions
        """
        gains = _chosen(g, self.g), _chosen(h, self.h), 0.0
        return _batch(self, 1, data, (self.x, self.dx), gains, save_predictions, saver)

    def VRF_prediction(self):
        """Variance of the predicted state in units of the measurement's."""
        return _filters.variance_reduction(self.g, self.h, None, self.dt)["prediction"]

    def VRF(self):
        """Variances of x and dx in units of the measurement's."""
        vrf = _filters.variance_reduction(self.g, self.h, None, self.dt)
        return vrf["x"], vrf["dx"]

    def __repr__(self):
        return described(
            self, "dt", "g", "h", "x", "dx", "x_prediction", "dx_prediction", "y", "z"
        )


class GHKFilter:
    """The g-h-k filter: position, velocity and acceleration with constant gains.

    Parameters and attributes are those of GHFilter, and ddx, ddx_prediction and k.
    """

    def __init__(self, x, dx, ddx, dt, g, h, k):
        self.x, self.dx, self.ddx = x, dx, ddx
        self.x_prediction, self.dx_prediction, self.ddx_prediction = x, dx, ddx
        self.dt, self.g, self.h, self.k = dt, g, h, k
        self.y = self.z = np.zeros(np.shape(x)) if np.ndim(x) else 0.0

    def update(self, z, g=None, h=None, k=None):
        """Predicts by one step and corrects with the measurement z; gains hold for this once.

        Returns (x, dx, ddx).
        """
        g, h, k = _chosen(g, self.g), _chosen(h, self.h), _chosen(k, self.k)
        self.ddx_prediction = self.ddx
        self.x_prediction, self.dx_prediction = predicted(self.x, self.dx, self.ddx, self.dt)
        self.z = z
        self.y = np.subtract(z, self.x_prediction)
        self.x, self.dx, self.ddx = corrected(
            self.x_prediction, self.dx_prediction, self.ddx, self.y, self.dt, g, h, k
        )
        return self.x, self.dx, self.ddx

    def batch_filter(self, data, save_predictions=False, saver=None, g=None, h=None, k=None):
        """As GHFilter.batch_filter(); a row of the results is x, dx, ddx."""
        gains = _chosen(g, self.g), _chosen(h, self.h), _chosen(k, self.k)
        state = (self.x, self.dx, self.ddx)
        return _batch(self, 2, data, state, gains, save_predictions, saver)

    def VRF_prediction(self):
        """Variance of the predicted state in units of the measurement's."""
        return _filters.variance_reduction(self.g, self.h, self.k, self.dt)["prediction"]

    def VRF(self):
        """Variances of x, dx and ddx in units of the measurement's."""
        vrf = _filters.variance_reduction(self.g, self.h, self.k, self.dt)
        return vrf["x"], vrf["dx"], vrf["ddx"]

    def bias_error(self, dddx):
        """Steady error of the prediction, estimate − truth, under a lasting jerk dddx.

        The filtered position is off by (1 − g) times as much.
        """
        return -(self.dt**3) * dddx / (2.0 * self.k)

    def __repr__(self):
        return described(
            self, "dt", "g", "h", "k", "x", "dx", "ddx",
            "x_prediction", "dx_prediction", "ddx_prediction", "y", "z",
        )  # fmt: skip


class GHFilterOrder:
    """The family under one name: order 0 (g), 1 (g-h) or 2 (g-h-k).

    Parameters
    ----------
    x0 : float or sequence
        Initial state; a sequence of order + 1 entries gives the derivatives, too. An entry may be
        an array of independent variables.
    dt : float
    order : 0, 1 or 2, the degree of the polynomial that the target is assumed to follow
    g, h, k : gains, as many as the order has

    Attributes
    ----------
    x : array (order + 1, …) of the state and its derivatives
    y : residual, z : last measurement
    """

    def __init__(self, x0, dt, order, g, h=None, k=None):
        if order not in (0, 1, 2):
            raise ValueError("order must be between 0 and 2")
        for name, gain, lowest in (("h", h, 1), ("k", k, 2)):
            if order >= lowest and gain is None:
                raise ValueError(f"a filter of order {order} needs the gain {name}")
        if np.ndim(x0) == 0:
            self.x = np.zeros(order + 1)
            self.x[0] = x0
        else:
            self.x = np.array(x0, dtype=float)
            if len(self.x) != order + 1:
                raise ValueError(f"x0 needs {order + 1} entries for order {order}")
        self.dt, self.order = dt, order
        self.g, self.h, self.k = g, h, k
        self.y = np.zeros(self.x.shape[1:]) if self.x.ndim > 1 else 0.0
        self.z = self.y

    def update(self, z, g=None, h=None, k=None):
        """Predicts by one step and corrects with the measurement z; gains hold for this once."""
        state = np.zeros((3,) + self.x.shape[1:])
        state[: self.order + 1] = self.x
        gains = [_chosen(g, self.g), _chosen(h, self.h), _chosen(k, self.k)]
        gains[self.order + 1 :] = [0.0] * (2 - self.order)
        x, dx = predicted(*state, self.dt)
        self.z = z
        self.y = np.subtract(z, x)
        state[:] = corrected(x, dx, state[2], self.y, self.dt, *gains)
        self.x = state[: self.order + 1]

    def __repr__(self):
        return described(self, "dt", "order", "x", "g", "h", "k", "y", "z")


def optimal_noise_smoothing(g):
    """(g, h, k) by the rule of Polge & Bhagavan (1975) for a given g below 1."""
    return _filters.polge_bhagavan(g)


def least_squares_parameters(n):
    """(g, h) that make a g-h filter the least-squares line through measurements 0 … n."""
    return _filters.growing_memory(1, n + 1)[:2]


def critical_damping_parameters(theta, order=2):
    """Gains of a critically damped filter, which forgets old measurements as theta^age.

    Parameters
    ----------
    theta : in [0, 1]
    order : number of gains: 2 for (g, h), 3 for (g, h, k)
    """
    if order not in (2, 3):
        raise ValueError("order must be 2 (g, h) or 3 (g, h, k)")
    return _filters.fading_memory(order - 1, theta)[:order]


def benedict_bordner_constants(g, critical=False):
    """(g, h) with h = g² / (2 − g), the best compromise of noise and steps of velocity
    (Benedict & Bordner 1962).

    Parameters
    ----------
    critical : take h = 2 − g − 2 √(1 − g) instead, with which the filter is critically damped
    """
    rule = _filters.critically_damped if critical else _filters.benedict_bordner
    return rule(g)[:2]


benedict_bornder_constants = benedict_bordner_constants
"""FilterPy's spelling."""
