"""Gaussians over one variable: densities, sums and products."""

import numpy as np

from ghtrack import _filters

__all__ = ["add", "gaussian", "mul", "mul_pdf"]


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
