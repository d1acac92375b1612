"""Kalman filters with matrices or plain numbers, and smoothing.

The tracker's own Kalman filters are in the program; these are the textbook's, for any linear model.
"""

import collections

import numpy as np

from ghtrack._recurrence import described

__all__ = ["FixedLagSmoother", "KalmanFilter", "batch_filter", "predict", "update"]


def predict(x, P, F=1.0, Q=0.0, u=0.0, B=1.0, alpha=1.0):
    """The prior (x, P): x = F x + B u, P = α² F P Fᵀ + Q. Plain numbers give plain numbers."""
    if np.ndim(x) == 0:
        return F * x + B * u, alpha * alpha * F * P * F + Q
    F = np.asarray(F, dtype=float)
    control = np.dot(B, u)
    return np.dot(F, x) + control, alpha * alpha * np.dot(np.dot(F, P), F.T) + Q


def update(x, P, z, R, H=None, return_all=False):
    """The posterior (x, P), with return_all (x, P, y, K, S, log_likelihood).

    y = z − H x, S = H P Hᵀ + R, K = P Hᵀ S⁻¹, x += K y, P = (I − K H) P (I − K H)ᵀ + K R Kᵀ,
    log-likelihood ln N(y; 0, S). Plain numbers give plain numbers; z None changes nothing.
    """
    if z is None:
        return (x, P, None, None, None, None) if return_all else (x, P)
    is_plain = np.ndim(x) == 0
    state = np.reshape(np.asarray(x, dtype=float), (-1, 1))
    covariance = np.atleast_2d(np.asarray(P, dtype=float))
    H = np.atleast_2d(np.ones(1) if H is None else np.asarray(H, dtype=float))
    R = np.atleast_2d(np.asarray(R, dtype=float))
    y = np.reshape(np.asarray(z, dtype=float), (-1, 1)) - H @ state
    S = H @ covariance @ H.T + R
    K = np.linalg.solve(S.T, H @ covariance.T).T
    state = state + K @ y
    keep = np.eye(len(state)) - K @ H
    covariance = keep @ covariance @ keep.T + K @ R @ K.T

    if is_plain:
        state, covariance, y, K, S = (float(a[0, 0]) for a in (state, covariance, y, K, S))
    else:
        state = state.reshape(np.shape(x))
        y = y.ravel() if np.ndim(x) == 1 else y
    if not return_all:
        return state, covariance
    return state, covariance, y, K, S, _log_likelihood(y, S)


def _log_likelihood(y, S):
    y, S = np.reshape(y, (-1, 1)), np.atleast_2d(S)
    _, log_determinant = np.linalg.slogdet(2.0 * np.pi * S)
    return float(-0.5 * (log_determinant + (y.T @ np.linalg.solve(S, y))[0, 0]))


def batch_filter(x, P, zs, Fs, Qs, Hs, Rs, Bs=None, us=None, update_first=False):
    """(means, covariances, prior means, prior covariances) over a series, with matrices of each step.

    None among the measurements is a missed one. With update_first each step corrects before it
    predicts, and the priors are those of the next step.
    """
    n = len(zs)
    Bs = [0.0] * n if Bs is None else Bs
    us = [0.0] * n if us is None else us
    rows = []
    for z, F, Q, H, R, B, u in zip(zs, Fs, Qs, Hs, Rs, Bs, us):
        if update_first:
            posterior = update(x, P, z, R, H)
            prior = x, P = predict(*posterior, F, Q, u, B)
        else:
            prior = predict(x, P, F, Q, u, B)
            posterior = x, P = update(*prior, z, R, H)
        rows.append((*map(np.copy, posterior), *map(np.copy, prior)))
    return tuple(np.array(column) for column in zip(*rows))


class KalmanFilter:
    """A linear Kalman filter. Set F, H, Q, R, and x and P to begin with.

    Attributes
    ----------
    x : state, (dim_x, 1) or (dim_x,); P : its covariance
    x_prior, P_prior : before the last update
    F : transition, Q : process noise, H : measurement function, R : its noise, B : control
    y : residual, S : its covariance, K : gain, z : measurement of the last update
    log_likelihood : of the last measurement
    """

    def __init__(self, dim_x, dim_z, dim_u=0):
        if dim_x < 1 or dim_z < 1 or dim_u < 0:
            raise ValueError("dimensions must be positive")
        self.dim_x, self.dim_z, self.dim_u = dim_x, dim_z, dim_u
        self.x = np.zeros((dim_x, 1))
        self.P, self.Q, self.F = np.eye(dim_x), np.eye(dim_x), np.eye(dim_x)
        self.H, self.R = np.zeros((dim_z, dim_x)), np.eye(dim_z)
        self.B = None
        self.z, self.y = np.zeros((dim_z, 1)), np.zeros((dim_z, 1))
        self.K, self.S = np.zeros((dim_x, dim_z)), np.zeros((dim_z, dim_z))
        self.x_prior, self.P_prior = self.x.copy(), self.P.copy()
        self.log_likelihood = -np.inf

    def predict(self, u=None, F=None, Q=None):
        """Carries the state one step on."""
        u, B = (0.0, 1.0) if u is None or self.B is None else (u, self.B)
        F, Q = (self.F if F is None else F), (self.Q if Q is None else Q)
        self.x, self.P = predict(self.x, self.P, F, Q, u, B)
        self.x_prior, self.P_prior = np.copy(self.x), np.copy(self.P)

    def update(self, z, R=None, H=None):
        """Corrects the state with a measurement; None is a missed one."""
        if z is None:
            return
        R, H = (self.R if R is None else R), (self.H if H is None else H)
        R = np.eye(self.dim_z) * R if np.ndim(R) == 0 else R
        self.z = z
        self.x, self.P, self.y, self.K, self.S, self.log_likelihood = update(
            self.x, self.P, z, R, H, return_all=True
        )

    def batch_filter(self, zs, update_first=False, saver=None):
        """(means, covariances, prior means, prior covariances) over a series; see batch_filter()."""
        rows = []
        for z in zs:
            if update_first:
                self.update(z)
                posterior = np.copy(self.x), np.copy(self.P)
                self.predict()
                prior = np.copy(self.x), np.copy(self.P)
            else:
                self.predict()
                prior = np.copy(self.x), np.copy(self.P)
                self.update(z)
                posterior = np.copy(self.x), np.copy(self.P)
            rows.append((*posterior, *prior))
            if saver is not None:
                saver.save()
        return tuple(np.array(column) for column in zip(*rows))

    @property
    def mahalanobis(self):
        """Distance of the last measurement from its prediction in sigmas."""
        y = np.ravel(self.y)
        return float(np.sqrt(y @ np.linalg.pinv(np.atleast_2d(self.S)) @ y))

    @property
    def likelihood(self):
        """Of the last measurement."""
        return float(np.exp(self.log_likelihood))

    def rts_smoother(self, Xs, Ps, Fs=None, Qs=None):
        """(x, P, K, Pp) of the Rauch-Tung-Striebel smoother over the results of batch_filter()."""
        n = len(Xs)
        Fs, Qs = ([self.F] * n if Fs is None else Fs), ([self.Q] * n if Qs is None else Qs)
        x, P, K, Pp = np.array(Xs), np.array(Ps), np.zeros_like(Ps), np.array(Ps)
        for k in range(n - 2, -1, -1):
            x_prior, Pp[k] = predict(x[k], P[k], Fs[k + 1], Qs[k + 1])
            K[k] = np.linalg.solve(Pp[k].T, np.dot(Fs[k + 1], P[k].T)).T
            x[k] = x[k] + K[k] @ (x[k + 1] - x_prior)
            P[k] = P[k] + K[k] @ (P[k + 1] - Pp[k]) @ K[k].T
        return x, P, K, Pp

    def __repr__(self):
        return described(self, "dim_x", "dim_z", "x", "P", "F", "Q", "H", "R", "y", "K", "S")


class FixedLagSmoother:
    """A Kalman filter whose estimates are corrected by the N measurements after them.

    With C the covariance of the error of an old estimate and that of the present prior (Simon,
    Optimal State Estimation, ch. 9.3), each innovation y corrects the old estimate, too:
    x_old += C Hᵀ S⁻¹ y, and C becomes C (I − K H)ᵀ Fᵀ for the next step. The results are those of
    the fixed-interval smoother over all measurements up to N steps later.

    Attributes
    ----------
    x, P, F, Q, H, R, B : as in KalmanFilter
    xSmooth : estimates after smooth(), one for each measurement; the last N may still change
    """

    def __init__(self, dim_x, dim_z, N=None):
        self.dim_x, self.dim_z, self.N = dim_x, dim_z, N
        self.x = np.zeros((dim_x, 1))
        self.P, self.Q, self.F = np.eye(dim_x), np.eye(dim_x), np.eye(dim_x)
        self.H, self.R = np.eye(dim_z, dim_x), np.eye(dim_z)
        self.K, self.y, self.S = np.zeros((dim_x, 1)), np.zeros((dim_z, 1)), np.eye(dim_z)
        self.B = 0.0
        self.count = 0
        self.xSmooth = []
        self._cross = collections.deque()

    def _advance(self, x, P, z, u, smoothed, cross, lag):
        """One step of the filter, which appends to `smoothed` and corrects its last entries.

        cross : C of each of these entries, the newest first
        """
        x, P = predict(x, P, self.F, self.Q, 0.0 if u is None else u, self.B)
        smoothed.append(np.copy(x))
        cross.appendleft(np.array(P))
        if len(cross) > lag + 1:
            cross.pop()
        R = np.eye(self.dim_z) * self.R if np.ndim(self.R) == 0 else self.R
        x, P, self.y, self.K, self.S, _ = update(x, P, z, R, self.H, return_all=True)
        information = self.H.T @ np.linalg.solve(self.S, np.reshape(self.y, (-1, 1)))
        carried = ((np.eye(self.dim_x) - self.K @ self.H).T) @ self.F.T
        for age, covariance in enumerate(cross):
            correction = (covariance @ information).reshape(np.shape(x))
            smoothed[-1 - age] = smoothed[-1 - age] + correction
            cross[age] = covariance @ carried
        return x, P

    def smooth(self, z, u=None):
        """Takes one measurement; xSmooth grows by one entry, the ones before it get better."""
        if self.N is None:
            raise ValueError("smooth() needs the lag N of the constructor")
        self.x, self.P = self._advance(self.x, self.P, z, u, self.xSmooth, self._cross, self.N)
        self.count += 1

    def smooth_batch(self, zs, N, us=None):
        """(smoothed, filtered) states over a series; state and xSmooth are left as they are."""
        x, P, smoothed, filtered, cross = self.x, self.P, [], [], collections.deque()
        for k, z in enumerate(zs):
            x, P = self._advance(x, P, z, None if us is None else us[k], smoothed, cross, N)
            filtered.append(np.copy(x))
        return np.array(smoothed), np.array(filtered)

    def __repr__(self):
        return described(self, "dim_x", "dim_z", "N", "x", "P", "F", "Q", "H", "R", "y", "K", "S")
