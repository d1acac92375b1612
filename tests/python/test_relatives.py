"""Least squares, fading memory, Kalman filters, smoothing, histograms and Gaussians."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from reference import cases, name_of

from ghtrack import discrete_bayes, kalman, stats
from ghtrack.common import Q_discrete_white_noise, Saver
from ghtrack.gh import GHKFilter
from ghtrack.kalman import KalmanFilter, batch_filter
from ghtrack.leastsq import LeastSquaresFilter
from ghtrack.memory import FadingMemoryFilter
from ghtrack.stats import gaussian, logpdf, mahalanobis, multivariate_gaussian, norm_cdf


def close(measured, expected, tolerance=1e-11):
    assert_allclose(measured, expected, rtol=tolerance, atol=tolerance)


# Derived: values of an independent program.
@pytest.mark.parametrize(
    "case", [case for case in cases("least_squares_filter") if "state" in case["expected"]], ids=name_of
)
def test_least_squares_equals_the_reference(case):
    filter_ = LeastSquaresFilter(**case["params"])
    order = case["params"]["order"]
    for step, z in enumerate(case["z"]):
        returned = filter_.update(z)
        close(returned, case["expected"]["state"][step])
        if step > order and "errors" in case["expected"]:  # before, a derivative is not determined
            close(filter_.K, case["expected"]["gains_K_physical_units"][step])
            close(filter_.errors()[0], case["expected"]["errors"][step])
    returned[0] = 1e9
    assert filter_.x[0] != 1e9
    filter_.reset()
    assert filter_.n == 0 and not filter_.x.any()


# Derived: the recursion is the least-squares polynomial through all points.
@pytest.mark.parametrize("order", [0, 1, 2])
def test_least_squares_is_the_polynomial_through_all_points(order):
    z = np.random.default_rng(3).normal(size=30).cumsum()
    filter_ = LeastSquaresFilter(0.1, order)
    for n, measured in enumerate(z, start=1):
        x = filter_.update(measured)
        if n > order:
            fit = np.polynomial.Polynomial.fit(0.1 * np.arange(1 - n, 1), z[:n], order, domain=[]).convert()
            close(x[0], fit(0.0), 1e-9)


# Derived: values of an independent program where it is right, closed forms elsewhere.
@pytest.mark.parametrize("case", cases("fading_memory_filter"), ids=name_of)
def test_fading_memory_equals_the_reference(case):
    params, expected = case["params"], case["expected"]
    filter_ = FadingMemoryFilter(case["init"]["x0"], params["dt"], params["order"], params["theta"])
    for step, z in enumerate(case["z"]):
        filter_.update(z)
        close(filter_.x, expected["state"][step])
    close(filter_.P, expected["variance_diag_unit_noise"])
    close(filter_.e, expected["truncation_error_per_unit_next_coefficient"])


# Derived: fading memory of order 2 is the g-h-k filter with g = 1 − β³, h = 3/2 (1 + β)(1 − β)²,
# k = (1 − β)³ / 2.
def test_fading_memory_is_a_ghk_filter():
    beta = 0.6
    gains = 1 - beta**3, 1.5 * (1 + beta) * (1 - beta) ** 2, 0.5 * (1 - beta) ** 3
    ghk, fading = GHKFilter(0, 0, 0, 1, *gains), FadingMemoryFilter(0, 1, 2, beta)
    for i in range(1, 100):
        ghk.update(0.02 * i**2 + 2 * i - 3)
        fading.update(0.02 * i**2 + 2 * i - 3)
        close(fading.x[0], ghk.x, 1e-13)


def test_fading_memory_keeps_fractions_of_whole_numbers_and_refuses_to_never_forget():
    filter_ = FadingMemoryFilter(np.array([0, 0]), 1.0, 1, 0.5)
    filter_.update(1)
    assert filter_.x[0] == 0.75
    with pytest.raises(ValueError):
        FadingMemoryFilter(0.0, 1.0, 1, 1.0)


# Derived: values of an independent program; the log-likelihood is that of the residual.
@pytest.mark.parametrize(
    "case", [case for case in cases("kalman_1d") if "steps" in case["expected"]], ids=name_of
)
def test_one_dimensional_kalman_equals_the_reference(case):
    params, (x, P) = case["params"], case["init"].values()
    for z, step in zip(case["z"], case["expected"]["steps"]):
        x, P = kalman.predict(x, P, params["F"], params["Q"], params["u"], alpha=params.get("alpha", 1.0))
        close((x, P), (step["x_prior"], step["P_prior"]))
        x, P, y, K, S, log_likelihood = kalman.update(x, P, z, params["R"], return_all=True)
        close((x, P, y, K), (step["x"], step["P"], step["y"], step["K"]))
        close(log_likelihood, -0.5 * (np.log(2 * np.pi * S) + y * y / S))
    assert isinstance(x, float)


def moving_target(seed, steps=60):
    """A matched constant-velocity model and measurements that it has made."""
    random = np.random.default_rng(seed)
    filter_ = kalman.KalmanFilter(2, 1)
    filter_.F = np.array([[1.0, 1.0], [0.0, 1.0]])
    filter_.H = np.array([[1.0, 0.0]])
    filter_.Q, filter_.R, filter_.P = 0.01 * np.diag([0.3, 1.0]), np.array([[4.0]]), 10.0 * np.eye(2)
    state, z = random.multivariate_normal([0, 0], filter_.P), []
    for _ in range(steps):
        state = filter_.F @ state + random.multivariate_normal([0, 0], filter_.Q)
        z.append(state[0] + 2.0 * random.normal())
    return filter_, z


# Derived: with a lag beyond the end, fixed-lag smoothing is fixed-interval smoothing.
@pytest.mark.parametrize("shape", [(2, 1), (2,)])
def test_a_long_lag_is_fixed_interval_smoothing(shape):
    filter_, z = moving_target(1)
    filter_.x = np.zeros(shape)
    smoother = kalman.FixedLagSmoother(2, 1, N=len(z))
    for name in ("x", "F", "H", "Q", "R", "P"):
        setattr(smoother, name, getattr(filter_, name))
    smoothed, filtered = smoother.smooth_batch(z, len(z))
    means, covariances, *_ = filter_.batch_filter(z)
    close(filtered, means)
    close(smoothed, filter_.rts_smoother(means, covariances)[0], 1e-9)


# Property: one by one or as a batch, the same; and a lag makes estimates better on the average.
def test_fixed_lag_smoothing_one_by_one_is_the_batch():
    filter_, z = moving_target(2)
    smoother = kalman.FixedLagSmoother(2, 1, N=5)
    for name in ("F", "H", "Q", "R", "P"):
        setattr(smoother, name, getattr(filter_, name))
    smoothed, filtered = smoother.smooth_batch(z, 5)
    for measured in z:
        smoother.smooth(measured)
    assert_array_equal(np.array(smoother.xSmooth), smoothed)
    assert smoother.count == len(z)


# Derived: values of an independent program.
@pytest.mark.parametrize("case", cases("discrete_bayes"), ids=name_of)
def test_histograms_equal_the_reference(case):
    given = case.get("input", {})
    if case["op"] == "predict":
        prior = discrete_bayes.predict(given["belief"], given["offset"], given["kernel"], given["mode"], given["cval"])
        close(prior, case["expected"]["prior"], 1e-14)
    elif case["op"] == "update":
        close(discrete_bayes.update(given["likelihood"], given["prior"]), case["expected"]["posterior"])
    elif case["op"] == "normalize":
        close(discrete_bayes.normalize(np.array(given["pdf"], dtype=float)), case["expected"]["pdf"])
    else:
        cells = len(given["hallway"])
        belief = np.full(cells, 1.0 / cells)
        for z, step in zip(given["measurements"], case["expected"]["steps"]):
            belief = discrete_bayes.predict(belief, given["move"], given["kernel"])
            close(belief, step["prior"])
            scale = given["z_prob"] / (1.0 - given["z_prob"])
            likelihood = np.where(np.array(given["hallway"]) == z, scale, 1.0)
            belief = discrete_bayes.update(likelihood, belief)
            close(belief, step["posterior"])


# Derived: convolution written out, for kernels of any width and moves beyond the row.
def test_prediction_is_a_convolution_on_a_ring():
    random = np.random.default_rng(4)
    for width in range(1, 22, 2):
        belief, kernel = random.normal(size=30), random.normal(size=width)
        move = int(random.integers(-70, 70))
        expected = np.zeros(30)
        for i in range(30):
            for j in range(width):
                expected[(i + move + j - width // 2) % 30] += belief[i] * kernel[j]
        close(discrete_bayes.predict(belief, move, kernel), expected, 1e-12)


def test_there_is_no_histogram_without_a_sum():
    for pdf in ([0.0, 0.0], [np.inf, 1.0], [np.nan, 1.0], [1.0, -1.0]):
        with pytest.raises(ValueError):
            discrete_bayes.normalize(np.array(pdf))
    with pytest.raises(ValueError):
        discrete_bayes.update([1.0], [0.5, 0.5])
    with pytest.raises(ValueError):
        discrete_bayes.predict([0.5, 0.5], 0.5, [1.0])
    counts = np.array([1, 3])
    close(discrete_bayes.normalize(counts), [0.25, 0.75])


# Derived: sums and products of Gaussians in closed form; the scale is the density of the difference.
def test_gaussians():
    assert stats.add(1.0, 2.0, 3.0, 4.0) == (4.0, 6.0)
    close(stats.mul(10.0, 2.0, 12.0, 6.0), (10.5, 1.5))
    mean, variance, scale = stats.mul_pdf(10.0, 2.0, 12.0, 6.0)
    x = np.linspace(5.0, 16.0, 7)
    product = stats.gaussian(x, 10.0, 2.0, normed=False) * stats.gaussian(x, 12.0, 6.0, normed=False)
    close(scale * stats.gaussian(x, mean, variance, normed=False), product)
    assert stats.gaussian(8, 1, 2) == pytest.approx(1.3498566943461957e-06)


def test_a_saver_reads_properties_first_and_keeps_lists_where_shapes_change():
    class Counter:
        def __init__(self):
            self.value, self._hidden = 0, 1

        @property
        def next(self):
            self.value += 1
            return self.value

    counter = Counter()
    saver = Saver(counter, save_current=True, skip_private=True)
    saver.save()
    assert saver.next == saver["value"] == [1, 2]
    assert "_hidden" not in saver.keys and len(saver) == 2
    counter.value = np.zeros(3)
    saver["value"] = [1, np.zeros(3)]
    with pytest.raises(ValueError, match="value"):
        saver.to_array()


# Derived: 68, 95 and 99.7 per cent lie within one, two and three sigmas.
def test_probability_between_two_values():
    for sigmas, share in ((1, 0.682689492), (2, 0.954499736), (3, 0.997300204)):
        assert norm_cdf((5 - 3 * sigmas, 5 + 3 * sigmas), 5, 9) == pytest.approx(share, abs=1e-9)
        assert norm_cdf((5 + 3 * sigmas, 5), 5, std=3) == pytest.approx(share / 2, abs=1e-9)


# Derived: ln N(x; m, C) = -(d' C^-1 d + ln det 2 pi C) / 2, and the distance is the root of d' C^-1 d.
def test_densities_and_distances_over_several_variables():
    x, mean, cov = [1.0, 2.0], [1.5, 1.0], np.array([[2.0, 0.5], [0.5, 1.0]])
    d = np.subtract(x, mean)
    square = d @ np.linalg.inv(cov) @ d
    assert mahalanobis(x, mean, cov) == pytest.approx(np.sqrt(square))
    expected = -0.5 * (square + np.log(np.linalg.det(2 * np.pi * cov)))
    assert logpdf(x, mean, cov) == pytest.approx(expected)
    assert multivariate_gaussian(x, mean, cov) == pytest.approx(np.exp(expected))
    assert multivariate_gaussian(1.0, 0.0, 4.0) == pytest.approx(gaussian(1.0, 0.0, 4.0))
    with pytest.raises(np.linalg.LinAlgError):
        logpdf(1.0, 1.0, -1.0)


# Derived: the noise enters position and rate as dt²/2 and dt.
def test_noise_of_a_model():
    assert_allclose(Q_discrete_white_noise(2, dt=0.5, var=4.0), 4.0 * np.outer([0.125, 0.5], [0.125, 0.5]))
    by_dim = Q_discrete_white_noise(3, dt=0.5, block_size=2)
    by_order = Q_discrete_white_noise(3, dt=0.5, block_size=2, order_by_dim=False)
    order = [0, 3, 1, 4, 2, 5]
    assert_allclose(by_order, by_dim[np.ix_(order, order)])


# Property: a batch is the filter step by step, missed measurements included.
@pytest.mark.parametrize("update_first", [False, True])
def test_a_batch_of_the_kalman_filter_is_its_steps(update_first):
    kf = KalmanFilter(2, 1)
    kf.F, kf.H, kf.Q, kf.R = np.array([[1.0, 0.5], [0.0, 1.0]]), np.array([[1.0, 0.0]]), 0.1 * np.eye(2), 2.0
    zs = [1.0, None, 2.5, 2.0, 4.0]
    x, P = kf.x.copy(), kf.P.copy()
    n = len(zs)
    whole = batch_filter(x, P, zs, [kf.F] * n, [kf.Q] * n, [kf.H] * n, [kf.R] * n, update_first=update_first)
    for ours, theirs in zip(whole, kf.batch_filter(zs, update_first=update_first)):
        assert_allclose(ours, theirs)
    assert whole[0].shape == (n, 2, 1)
    assert kf.mahalanobis == pytest.approx(mahalanobis(np.zeros(1), kf.y, kf.S))
