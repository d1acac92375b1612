"""Gaussians: densities, sums and products over one variable, densities and distances over more."""

import math

import numpy as np

from ghtrack import _filters

__all__ = [
    "add",
    "gaussian",
    "log_likelihood",
    "logpdf",
    "mahalanobis",
    "mul",
    "mul_pdf",
    "multivariate_gaussian",
    "norm_cdf",
]


def gaussian(x, mean, var, normed=True):
    """Density of N(mean, var) at x. Where x is an array, the densities are scaled to the sum 1
    unless normed is False."""
    x = np.asarray(x, dtype=float)
    density = np.exp(-((x - mean) ** 2) / (2.0 * var)) / np.sqrt(2.0 * np.pi * var)
    if not density.ndim:
        return float(density)
    return density / density.sum() if normed else density


def add(mean1, var1, mean2, var2):
    """(mean, variance) of the sum of two independent variables."""
    return _filters.gaussian_sum(mean1, var1, mean2, var2)


def mul(mean1, var1, mean2, var2):
    """(mean, variance) of the normalized product: two independent opinions on one variable."""
    return _filters.gaussian_product(mean1, var1, mean2, var2)


def mul_pdf(mean1, var1, mean2, var2):
    """(mean, variance, scale) of the product as it is: scale times a Gaussian."""
    mean, variance = mul(mean1, var1, mean2, var2)
    total = var1 + var2
    scale = np.exp(-((mean1 - mean2) ** 2) / (2.0 * total)) / np.sqrt(2.0 * np.pi * total)
    return mean, variance, float(scale)


def norm_cdf(x_range, mu, var=1, std=None):
    """Probability that a Gaussian lies between the two ends of x_range, in either order."""
    std = math.sqrt(var) if std is None else std
    below = [0.5 * (1.0 + math.erf((x - mu) / (std * math.sqrt(2.0)))) for x in x_range]
    return abs(below[1] - below[0])


def _vector(values):
    vector = np.ravel(np.asarray(values, dtype=float))
    if vector.size != np.size(np.squeeze(values)):
        raise ValueError("a vector is needed")
    return vector


def _difference(x, mean, cov):
    """x - mean, and the covariance as a matrix that fits it."""
    x, mean = _vector(x), _vector(mean)
    if x.size != mean.size and mean.size != 1:
        raise ValueError(f"x has {x.size} entries and the mean {mean.size}")
    cov = np.asarray(cov, dtype=float)
    return x - mean, cov.reshape(1, 1) * np.eye(x.size) if cov.size == 1 else cov


def mahalanobis(x, mean, cov):
    """Distance of x from the mean in sigmas: the root of (x - mean)' cov^-1 (x - mean)."""
    d, cov = _difference(x, mean, cov)
    return float(np.sqrt(d @ np.linalg.inv(cov) @ d))


def logpdf(x, mean=None, cov=1, allow_singular=True):
    """Logarithm of the density of N(mean, cov) at x; of a singular one, within its support."""
    d, cov = _difference(x, np.zeros(np.size(x)) if mean is None else mean, cov)
    values, vectors = np.linalg.eigh(cov)
    least = values.max(initial=0.0) * len(values) * np.finfo(float).eps
    wide = values > least
    if values.min() < -least or not wide.any() or not (wide.all() or allow_singular):
        raise np.linalg.LinAlgError("the covariance must be positive definite")
    along = (d @ vectors)[wide] / np.sqrt(values[wide])
    return float(-0.5 * (along @ along + np.log(2.0 * np.pi * values[wide]).sum()))


def multivariate_gaussian(x, mu, cov):
    """Density of N(mu, cov) at x."""
    return math.exp(logpdf(x, mu, cov))


def log_likelihood(z, x, P, H, R):
    """Logarithm of the likelihood of the measurement z, expected at H x with covariance H P H' + R."""
    return logpdf(z, np.dot(H, x), np.dot(H, np.dot(P, np.transpose(H))) + R)
