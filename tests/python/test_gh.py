"""Filters of the g-h family as FilterPy's users know them."""

import inspect

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from reference import cases, name_of

from ghtrack import _filters
from ghtrack.common import Saver
from ghtrack.gh import (
    GHFilter,
    GHFilterOrder,
    GHKFilter,
    benedict_bordner_constants,
    critical_damping_parameters,
    least_squares_parameters,
    optimal_noise_smoothing,
)


def close(measured, expected):
    assert_allclose(measured, expected, rtol=1e-11, atol=1e-11)


def overrides(case, *names):
    """The keyword arguments of each update."""
    for step in range(len(case["z"])):
        lists = {name: case.get(f"{name}_override") for name in names}
        yield {name: values[step] for name, values in lists.items() if values}


def as_arrays(values):
    return {name: np.array(value) if isinstance(value, list) else value for name, value in values.items()}


# Derived: values of an independent program.
@pytest.mark.parametrize(
    "case",
    [
        case
        for name in ("gh_random_overrides", "gh_vector", "textbook_weights", "filterpy_examples")
        for case in cases(name)
        if "x" in case["expected"]
    ],
    ids=name_of,
)
def test_gh_updates_equal_the_reference(case):
    filter_ = GHFilter(**as_arrays(case["init"]), **case["params"])
    expected = case["expected"]
    for step, (z, gains) in enumerate(zip(case["z"], overrides(case, "g", "h"))):
        if case.get("dt_per_step"):
            filter_.dt = case["dt_per_step"][step]
        returned = filter_.update(np.array(z) if isinstance(z, list) else z, **gains)
        close(returned[0], expected["x"][step])
        close(returned[1], expected["dx"][step])
        close(filter_.x_prediction, expected["x_pred"][step])
        close(filter_.dx_prediction, expected["dx_pred"][step])
        close(filter_.y, expected["residual"][step])
        assert_array_equal(filter_.z, z)


# Derived: values of an independent program.
@pytest.mark.parametrize("case", cases("ghk_update"), ids=name_of)
def test_ghk_updates_equal_the_reference(case):
    filter_ = GHKFilter(**as_arrays(case["init"]), **case["params"])
    expected = case["expected"]
    for step, (z, gains) in enumerate(zip(case["z"], overrides(case, "g", "h", "k"))):
        if case.get("dt_per_step"):
            filter_.dt = case["dt_per_step"][step]
        x, dx, ddx = filter_.update(np.array(z) if isinstance(z, list) else z, **gains)
        close(x, expected["x"][step])
        close(dx, expected["dx"][step])
        close(ddx, expected["ddx"][step])
        close(filter_.ddx_prediction, expected["ddx_pred"][step])
        close(filter_.y, expected["residual"][step])


# Derived: values of an independent program; the first row is the initial state.
@pytest.mark.parametrize("case", cases("gh_batch"), ids=name_of)
def test_a_batch_equals_the_reference(case):
    filter_ = GHFilter(**case["init"], **case["params"])
    results, predictions = filter_.batch_filter(case["z"], save_predictions=True)
    close(results, case["expected"]["results_rows_x_dx_first_row_is_initial_state"])
    assert predictions.shape == (len(case["z"]),)
    assert (filter_.x, filter_.dx) == (case["init"]["x"], case["init"]["dx"])


# Derived: a batch is a loop of updates, the acceleration included.
@pytest.mark.parametrize("case", cases("ghk_batch"), ids=name_of)
def test_a_batch_with_acceleration_equals_the_reference(case):
    results, predictions = GHKFilter(**case["init"], **case["params"]).batch_filter(
        case["z"], save_predictions=True
    )
    for column, name in enumerate(("x", "dx", "ddx")):
        close(results[1:, column], case["expected"][name])
        assert results[0, column] == case["init"][name]
    close(predictions, case["expected"]["x_pred"])


# Derived: values of an independent program.
@pytest.mark.parametrize("case", cases("gh_filter_order"), ids=name_of)
def test_any_order_equals_the_reference(case):
    x0 = case["init"]["x0"]
    filter_ = GHFilterOrder(x0, **case["params"])
    for step, (z, gains) in enumerate(zip(case["z"], overrides(case, "g", "h", "k"))):
        filter_.update(z, **gains)
        close(filter_.x, case["expected"]["state"][step])


# Property: update() in Python and the batch in C++ give the same bits, for any gains and steps.
@pytest.mark.parametrize("seed", range(20))
def test_updates_and_batches_give_the_same_bits(seed):
    random = np.random.default_rng(seed)
    lanes = random.integers(1, 5)
    x, dx, ddx = random.normal(size=(3, lanes))
    dt, g, h, k = random.uniform(0.01, 1.0, size=4)
    data = random.normal(size=(50, lanes))
    for filter_ in (GHFilter(x, dx, dt, g, h), GHKFilter(x, dx, ddx, dt, g, h, k)):
        results, predictions = filter_.batch_filter(data, save_predictions=True)
        for step, z in enumerate(data):
            state = filter_.update(z)
            assert_array_equal(predictions[step], filter_.x_prediction)
            assert_array_equal(results[step + 1], np.array(state))


# Property: a long series of one variable, which goes through pieces of it side by side, has the bits
# of the same series beside another one.
@pytest.mark.parametrize("gains", [(0.5, 0.1), (0.02, 0.0002), (1.4, 1.0), (1e-5, 1e-9)])
def test_long_series_have_the_same_bits(gains):
    random = np.random.default_rng(8)
    data = random.normal(size=(100_003, 2))
    data[random.random(size=data.shape) < 0.01] = np.nan
    alone = GHFilter(1.0, -1.0, 0.25, *gains).batch_filter(data[:, 0], save_predictions=True)
    both = GHFilter(np.array([1.0, 0.0]), -1.0, 0.25, *gains).batch_filter(data, save_predictions=True)
    assert_array_equal(alone[0], both[0][:, :, 0])
    assert_array_equal(alone[1], both[1][:, 0])


# Property: variables side by side do not know of each other, and numbers equal arrays of one.
def test_variables_are_independent():
    random = np.random.default_rng(5)
    data = random.normal(size=(40, 2))
    both = GHFilter(np.array([0, 1]), np.array([0, 0]), 1.0, 0.8, 0.2)
    first, second = GHFilter(0, 0, 1.0, 0.8, 0.2), GHFilter([1], [0], 1.0, 0.8, 0.2)
    second.x, second.dx = np.array([1]), np.array([0])
    for z in data:
        both.update(z)
        first.update(z[0])
        second.update(z[1])
        assert both.x[0] == first.x and both.x[1] == second.x[0]
        assert both.dx[0] == first.dx and both.dx[1] == second.dx[0]
    assert both.VRF() == first.VRF() == second.VRF()


# Property: gains for each step are those of an update with these gains; a missed measurement is a
# prediction.
def test_a_batch_takes_gains_for_each_step_and_missed_measurements():
    data = [1.0, 2.5, None, 4.0, float("nan"), 6.5]
    gains = [least_squares_parameters(step) for step in range(len(data))]
    g, h = zip(*gains)
    filter_ = GHFilter(0.0, 0.0, 0.5, 0.1, 0.1)
    results, predictions = filter_.batch_filter(data, save_predictions=True, g=g, h=h)
    for step, z in enumerate(data):
        if z is None or np.isnan(z):
            assert results[step + 1, 0] == predictions[step]
            filter_.x, filter_.dx = results[step + 1]
        else:
            assert_array_equal(filter_.update(z, g[step], h[step]), results[step + 1])
    with pytest.raises(ValueError, match="one for each of the 6 measurements"):
        filter_.batch_filter(data, g=[0.1, 0.2])


# Property: a saver sees each step of a batch, and the filter is as it was before.
def test_a_saver_sees_each_step_of_a_batch():
    filter_ = GHFilter(0.0, 1.0, 1.0, 0.6, 0.3)
    saver = Saver(filter_)
    results = filter_.batch_filter([1.0, 2.2, 2.9], saver=saver)
    saver.to_array()
    assert len(saver) == 3
    assert_array_equal(saver.x, results[1:, 0])
    assert_array_equal(saver.z, [1.0, 2.2, 2.9])
    assert (filter_.x, filter_.dx, filter_.z) == (0.0, 1.0, 0.0)


# Derived: closed forms of the steady covariance, checked by Lyapunov's equation.
@pytest.mark.parametrize("case", cases("vrf"), ids=name_of)
def test_variance_reduction_equals_the_closed_form(case):
    params, expected = case["params"], case["expected"]
    if "k" in params:
        filter_ = GHKFilter(0, 0, 0, params["dt"], params["g"], params["h"], params["k"])
        close(filter_.VRF(), [expected["vrf_x"], expected["vrf_dx"], expected["vrf_ddx"]])
    else:
        filter_ = GHFilter(0, 0, params["dt"], params["g"], params["h"])
        close(filter_.VRF(), [expected["vrf_x"], expected["vrf_dx"]])
    close(filter_.VRF_prediction(), expected["vrf_x_pred"])


# Derived: the prediction's steady error under a jerk J is -J T³ / 2k.
def test_bias_error_is_that_of_the_prediction_under_a_lasting_jerk():
    dt, jerk = 0.5, 2.0
    filter_ = GHKFilter(0.0, 0.0, 0.0, dt, *optimal_noise_smoothing(0.5))
    for step in range(1, 400):
        t = step * dt
        filter_.update(jerk * t**3 / 6.0)
    assert_allclose(filter_.x_prediction - jerk * t**3 / 6.0, filter_.bias_error(jerk), rtol=1e-6)


# Derived: values with 50 digits, and the closed forms of each rule.
def test_rules_equal_the_reference():
    damping, rule, critical, smoothing = cases("gain_design")
    expected = damping["expected"]
    for theta, pair, triple in zip(expected["theta"], expected["order1_g_h"], expected["order2_g_h_k"]):
        close(critical_damping_parameters(theta), pair)
        close(critical_damping_parameters(theta, order=3), triple)
    for g, h in zip(rule["expected"]["g"], rule["expected"]["h"]):
        close(benedict_bordner_constants(g), (g, h))
    for g, h in zip(critical["expected"]["g"], critical["expected"]["h_exact_critical"]):
        close(benedict_bordner_constants(g, critical=True), (g, h))
    for row in smoothing["expected"]["rows"]:
        close(optimal_noise_smoothing(row["g"]), (row["g"], row["h_filterpy"], row["k_filterpy"]))


# Derived: h = 4 − 2g − √(4 (g − 2)² − 3 g²) for least squares, another form of the same gains.
def test_least_squares_gains_satisfy_their_other_form():
    for n in range(1, 100):
        g, h = least_squares_parameters(n)
        assert abs(4 - 2 * g - (4 * (g - 2) ** 2 - 3 * g**2) ** 0.5 - h) < 1e-12


# Property: what cannot be right raises ValueError and does not end the interpreter.
@pytest.mark.parametrize(
    "call",
    [
        lambda: GHFilterOrder(0.0, 1.0, 3, 0.5),
        lambda: GHFilterOrder(0.0, 1.0, 1, 0.5),
        lambda: GHFilterOrder([0.0], 1.0, 2, 0.5, 0.1, 0.1),
        lambda: critical_damping_parameters(1.5),
        lambda: critical_damping_parameters(0.5, order=1),
        lambda: benedict_bordner_constants(0.0),
        lambda: optimal_noise_smoothing(1.0),
        lambda: least_squares_parameters(-1),
        lambda: GHFilter(0, 0, 1.0, 3.0, 1.0).VRF(),
        lambda: GHFilter(0, 0, 0.0, 0.5, 0.1).batch_filter([1.0]),
        lambda: GHFilter(0, 0, float("nan"), 0.5, 0.1).batch_filter([1.0]),
        lambda: GHFilter([0, 0], [0, 0, 0], 1.0, 0.5, 0.1).batch_filter([[1.0, 2.0]]),
        lambda: _filters.batch(2, np.zeros((3, 1)), np.zeros((2, 1)), 1.0, *np.zeros((3, 3)), True),
    ],
)
def test_what_cannot_be_right_raises(call):
    with pytest.raises(ValueError):
        call()


def test_everything_is_documented_and_described():
    for filter_ in (GHFilter(0, 0, 1, 0.5, 0.1), GHKFilter(0, 0, 0, 1, 0.5, 0.1, 0.01), GHFilterOrder(0, 1, 0, 0.5)):
        assert type(filter_).__name__ in str(filter_)
        for name, member in inspect.getmembers(filter_, inspect.ismethod):
            assert name.startswith("_") or member.__doc__, name
