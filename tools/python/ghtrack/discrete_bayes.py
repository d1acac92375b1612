"""The histogram filter: a belief is one probability for each of a row of cells."""

import numpy as np

from ghtrack import _filters

__all__ = ["normalize", "predict", "update"]


def normalize(pdf):
    """Scales pdf to the sum 1, in place where it is an array of floats, and returns it.

    Raises ValueError where the sum is zero or not finite: there is no such distribution.
    """
    values = np.asarray(pdf, dtype=float)
    total = values.sum()
    if not np.isfinite(total) or total == 0.0:
        raise ValueError("cannot normalize: the sum is zero or not finite")
    if values is pdf:
        pdf /= total
        return pdf
    return values / total


def update(likelihood, prior):
    """The posterior: likelihood times prior, normalized."""
    likelihood, prior = np.asarray(likelihood, float), np.asarray(prior, float)
    if likelihood.shape != prior.shape:
        raise ValueError("likelihood and prior must have one entry for each cell")
    return normalize(likelihood * prior)


def predict(pdf, offset, kernel, mode="wrap", cval=0.0):
    """The prior: pdf moved by offset cells and spread by the kernel.

    Parameters
    ----------
    pdf : belief, one entry a cell
    offset : cells to move to the right; negative: to the left
    kernel : probability of each deviation from the offset, its centre the one of no deviation
    mode : "wrap" for a ring; anything else for a row beyond whose ends every cell holds cval
    """
    if int(offset) != offset:
        raise ValueError("offset must be a whole number of cells")
    return _filters.discrete_bayes_predict(pdf, int(offset), kernel, mode == "wrap", cval)
