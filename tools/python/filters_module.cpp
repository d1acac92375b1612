// `ghtrack._filters`: the filters and rules that need nothing but the tracker library.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "tracker/filters/batch.hpp"
#include "tracker/filters/discrete_bayes.hpp"
#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/polynomial_memory.hpp"
#include "tracker/filters/gains/rules.hpp"
#include "tracker/filters/gaussian.hpp"
#include "tracker/filters/kinematics.hpp"

namespace py = pybind11;

namespace ghtrack {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Vector1 = Kinematics<1>::Vector;
using Triple = std::tuple<double, double, double>;

Triple triple(const Gains& gains) { return {gains.g, gains.h, gains.k}; }

Gains gains_of(double g, double h, std::optional<double> k) {
  return k ? Gains::of_ghk(g, h, *k) : Gains::of_gh(g, h);
}

py::dict variance_reduction_of(double g, double h, std::optional<double> k, double dt) {
  const VarianceReduction vrf = variance_reduction(gains_of(g, h, k), dt);
  py::dict result;
  result["x"] = vrf.x;
  result["dx"] = vrf.dx;
  result["ddx"] = vrf.ddx;
  result["prediction"] = vrf.prediction;
  return result;
}

/// A series of `steps` measurements of `lanes` independent variables, as one batch filters it.
struct Batch {
  py::ssize_t steps, lanes;
  int order;
  double dt;
  const double* z;    // by step and lane; NaN: missed
  double* estimates;  // by step, derivative and lane; the initial state is there already

  /// @param gains_at  the gains of a step
  template <class GainsAt>
  void run(GainsAt gains_at) const {
    for (py::ssize_t lane = 0; lane < lanes; ++lane) {
      Kinematics<1> now = state(0, lane);
      for (py::ssize_t step = 0; step < steps; ++step) {
        const Kinematics<1> prior = extrapolated(now, dt);
        const double measured = z[step * lanes + lane];
        const Vector1 residual(std::isnan(measured) ? 0.0 : measured - prior.position[0]);
        now = corrected<1>(prior, residual, gains_at(step), dt);
        double* const out = estimates + (step + 1) * row() + lane;
        out[0] = now.position[0];
        out[lanes] = now.velocity[0];
        if (order == 2) out[2 * lanes] = now.acceleration[0];
      }
    }
  }

  /// The same for one variable and constant gains.
  void run_quickly(const Gains& gains) const {
    filter_series(gains, dt, state(0, 0), {z, static_cast<std::size_t>(steps)},
                  {estimates + row(), static_cast<std::size_t>(row() * steps)});
  }

  /// @param predictions  by step and lane
  void predict(double* predictions) const {
    for (py::ssize_t step = 0; step < steps; ++step) {
      for (py::ssize_t lane = 0; lane < lanes; ++lane) {
        *predictions++ = extrapolated(state(step, lane), dt).position[0];
      }
    }
  }

 private:
  py::ssize_t row() const { return (order + 1) * lanes; }

  Kinematics<1> state(py::ssize_t step, py::ssize_t lane) const {
    const double* const from = estimates + step * row() + lane;
    return {Vector1(from[0]), Vector1(from[lanes]), Vector1(order == 2 ? from[2 * lanes] : 0.0)};
  }
};

/// @param z      (steps, lanes); NaN: missed
/// @param state  (order + 1, lanes)
/// @param g      one number, or one for each step; as h and k
/// @return (steps + 1, order + 1, lanes) estimates and (steps, lanes) predictions, or None
std::pair<Array, std::optional<Array>> batch(int order, const Array& z, const Array& state,
                                             double dt, const Array& g, const Array& h,
                                             const Array& k, bool with_predictions) {
  if (order < 1 || order > 2) throw std::invalid_argument("order must be 1 or 2");
  if (!(dt > 0.0) || !std::isfinite(dt)) throw std::invalid_argument("dt must be positive");
  const auto fits = [&z](const Array& gain) {
    return gain.size() == 1 || gain.size() == z.shape(0);
  };
  if (z.ndim() != 2 || state.ndim() != 2 || state.shape(0) != order + 1 ||
      state.shape(1) != z.shape(1) || !fits(g) || !fits(h) || !fits(k)) {
    throw std::invalid_argument("shapes of measurements, state and gains do not fit together");
  }
  const py::ssize_t steps = z.shape(0);
  const py::ssize_t lanes = z.shape(1);
  Array estimates({steps + 1, static_cast<py::ssize_t>(order + 1), lanes});
  std::copy_n(state.data(), state.size(), estimates.mutable_data());
  std::optional<Array> predictions;
  if (with_predictions) predictions.emplace(std::vector<py::ssize_t>{steps, lanes});
  double* const to_predictions = predictions ? predictions->mutable_data() : nullptr;

  const Batch series{.steps = steps,
                     .lanes = lanes,
                     .order = order,
                     .dt = dt,
                     .z = z.data(),
                     .estimates = estimates.mutable_data()};
  const auto entry = [](const Array& gain) {
    return [data = gain.data(), stride = gain.size() == 1 ? 0 : 1](py::ssize_t step) {
      return data[stride * step];
    };
  };
  const auto gains_at = [order, g = entry(g), h = entry(h), k = entry(k)](py::ssize_t step) {
    return Gains{order, g(step), h(step), k(step)};
  };
  const bool is_constant = g.size() == 1 && h.size() == 1 && k.size() == 1;
  {
    const py::gil_scoped_release release;
    if (is_constant && lanes == 1) {
      series.run_quickly(gains_at(0));
    } else {
      series.run(gains_at);
    }
    if (to_predictions != nullptr) series.predict(to_predictions);
  }
  return {estimates, predictions};
}

Array predict_belief(const std::vector<double>& belief, int offset,
                     const std::vector<double>& kernel, bool wraps, double beyond) {
  using discrete_bayes::Edge;
  const auto prior = discrete_bayes::predicted(belief, offset, kernel,
                                               wraps ? Edge::kWrap : Edge::kConstant, beyond);
  return Array(static_cast<py::ssize_t>(prior.size()), prior.data());
}

std::pair<double, double> pair(const Gaussian& gaussian) {
  return {gaussian.mean, gaussian.variance};
}

}  // namespace

PYBIND11_MODULE(_filters, m) {
  m.def("batch", &batch);
  m.def("variance_reduction", &variance_reduction_of);
  m.def("growing_memory", [](int order, int n) { return triple(growing_memory_gains(order, n)); });
  m.def("fading_memory",
        [](int order, double theta) { return triple(fading_memory_gains(order, theta)); });
  m.def("benedict_bordner", [](double g) { return triple(benedict_bordner_gains(g)); });
  m.def("critically_damped", [](double g) { return triple(critically_damped_gains(g)); });
  m.def("polge_bhagavan", [](double g) { return triple(polge_bhagavan_gains(g)); });
  m.def("growing_memory_sigma", &growing_memory_sigma);
  m.def("fading_memory_variance", &fading_memory_variance);
  m.def("fading_memory_truncation_error", &fading_memory_truncation_error);
  m.def("discrete_bayes_predict", &predict_belief);
  m.def("gaussian_sum", [](double mean1, double var1, double mean2, double var2) {
    return pair(sum({mean1, var1}, {mean2, var2}));
  });
  m.def("gaussian_product", [](double mean1, double var1, double mean2, double var2) {
    return pair(product({mean1, var1}, {mean2, var2}));
  });
}

}  // namespace ghtrack
