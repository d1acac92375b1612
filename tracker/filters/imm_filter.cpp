#include "tracker/filters/imm_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

/// What is known of one mode's state by another: components that both have come from the other, the
/// rest from the mode itself.
struct Lifted {
  MotionState x;
  MotionCovariance p;
};

template <int D>
Lifted lifted(const MotionFilter<D>& from, const MotionFilter<D>& to) {
  const bool is_alike =
      from.motion().index() == to.motion().index() && from.state().size() == to.state().size();
  if (is_alike) return {from.state(), from.covariance()};
  Lifted known{to.state(), to.covariance()};
  const Eigen::Index n = known.x.size();
  std::vector<int> source(static_cast<std::size_t>(n), -1);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < from.state().size(); ++j) {
      if (component_of(to.motion(), i, D) == component_of(from.motion(), j, D)) {
        source[static_cast<std::size_t>(i)] = j;
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    const int a = source[static_cast<std::size_t>(i)];
    if (a >= 0) known.x[i] = from.state()[a];
    for (int j = 0; j < n; ++j) {
      const int b = source[static_cast<std::size_t>(j)];
      if (a >= 0 && b >= 0) {
        known.p(i, j) = from.covariance()(a, b);
      } else if (a >= 0 || b >= 0) {
        known.p(i, j) = 0.0;
      }
    }
  }
  return known;
}

}  // namespace

template <int D>
ImmFilter<D>::ImmFilter(std::vector<Mode> modes, double switching)
    : modes_(std::move(modes)),
      chain_(modes_.size(), switching,
             modes_.empty() ? 1.0 : modes_.front().filter.nominal_interval(),
             modes_.empty() ? 1.0 : modes_.front().filter.sigma(), D) {
  for (Mode& mode : modes_) mode.weight = 1.0 / static_cast<double>(modes_.size());
}

template <int D>
bool ImmFilter<D>::start(const Vector& z, const Matrix& covariance) {
  for (Mode& mode : modes_) {
    if (!mode.filter.start(z, covariance)) {
      ++refusals_.measurements;
      return false;
    }
    mode.weight = 1.0 / static_cast<double>(modes_.size());
  }
  residual_.reset();
  chain_.start(widest_variance());
  measured_.clear();
  leader_ = 0;
  updates_ = 1;
  misses_ = 0;
  combine();
  prior_ = estimate_;
  return true;
}

template <int D>
void ImmFilter<D>::start_from(const Kinematics<D>& guess) {
  if (!start(guess.position)) return;
  for (Mode& mode : modes_) mode.filter.start_from(guess);
  combine();
  prior_ = estimate_;
  updates_ = 0;
}

/// The largest variance that a mode takes the position to have.
template <int D>
double ImmFilter<D>::widest_variance() const {
  double widest = 0.0;
  for (const Mode& mode : modes_) {
    widest = std::max(widest, mode.filter.innovation_covariance(Matrix::Zero()).trace());
  }
  return widest;
}

/// Mixes the modes by the transitions of the chain that are due, and gives them the weights c_j.
template <int D>
void ImmFilter<D>::mix() {
  const double leaving = chain_.leaving();
  if (leaving == 0.0) return;
  const double stay = 1.0 - leaving;
  const double leave = leaving / (static_cast<double>(modes_.size()) - 1.0);

  std::vector<double> arrived(modes_.size());
  std::vector<Lifted> mixtures;
  mixtures.reserve(modes_.size());
  std::vector<std::pair<double, Lifted>> parts;
  parts.reserve(modes_.size());
  for (std::size_t j = 0; j < modes_.size(); ++j) {
    const MotionFilter<D>& own = modes_[j].filter;
    Lifted mixture{MotionState::Zero(own.state().size()),
                   MotionCovariance::Zero(own.state().size(), own.state().size())};
    parts.clear();
    for (std::size_t i = 0; i < modes_.size(); ++i) {
      const double weight = (i == j ? stay : leave) * modes_[i].weight;
      arrived[j] += weight;
      parts.emplace_back(weight, lifted(modes_[i].filter, own));
    }
    for (const auto& [weight, part] : parts) mixture.x += weight / arrived[j] * part.x;
    for (const auto& [weight, part] : parts) {
      const MotionState d = part.x - mixture.x;
      mixture.p += weight / arrived[j] * (part.p + d * d.transpose());
    }
    mixtures.push_back(std::move(mixture));
  }
  for (std::size_t j = 0; j < modes_.size(); ++j) {
    modes_[j].filter.set_state(mixtures[j].x, mixtures[j].p);
    modes_[j].weight = arrived[j];
  }
}

template <int D>
bool ImmFilter<D>::predict(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    ++refusals_.times;
    return false;
  }
  if (!is_started()) return true;
  ImmFilter next = *this;
  if (measured_.empty()) {
    next.measured_ = modes_;
  } else {
    next.modes_ = measured_;
  }
  next.chain_.predict(dt);
  next.mix();
  const bool all = std::all_of(next.modes_.begin(), next.modes_.end(), [&](Mode& mode) {
    return mode.filter.predict(next.chain_.elapsed());
  });
  next.combine();
  if (!all || !next.is_finite()) {
    ++refusals_.times;
    return false;
  }
  *this = std::move(next);
  residual_.reset();
  prior_ = estimate_;
  return true;
}

template <int D>
bool ImmFilter<D>::update(const Vector& z, const Matrix& covariance) {
  if (!is_started()) return start(z, covariance);
  const Vector expected = estimate_.position;
  if (!update_modes([&](auto& filter) { return filter.update(z, covariance); },
                    covariance.trace())) {
    return false;
  }
  residual_ = z - expected;
  return true;
}

template <int D>
bool ImmFilter<D>::update(const Measurement& measured) requires(D == 2) {
  if (std::holds_alternative<PositionModel>(measured.model)) {
    return update(Vector(measured.z), Matrix(measured.r));
  }
  if constexpr (D == 2) {  // Clang 14 compiles this for one axis, too
    return update_modes([&](auto& filter) { return filter.update(measured); },
                        std::numeric_limits<double>::infinity());
  }
  return false;
}

/// @param error  variance of the measurement, see ModeChain::update
template <int D>
template <class UpdateMode>
bool ImmFilter<D>::update_modes(const UpdateMode& update_mode, double error) {
  ImmFilter next = *this;
  const bool all = std::all_of(next.modes_.begin(), next.modes_.end(),
                               [&](Mode& mode) { return update_mode(mode.filter); });
  if (all) next.weigh();
  next.chain_.update(next.widest_variance(), error);
  next.measured_.clear();
  next.combine();
  if (!all || !next.is_finite()) {
    ++refusals_.measurements;
    return false;
  }
  next.prior_ = estimate_;
  next.residual_ = next.estimate_.position - estimate_.position;
  next.misses_ = 0;
  ++next.updates_;
  *this = std::move(next);
  return true;
}

/// Gives the modes weights by how well each has foreseen the measurement.
template <int D>
void ImmFilter<D>::weigh() {
  const auto log_of = [](const Mode& mode) { return mode.filter.log_likelihood(); };
  const double best =
      log_of(*std::max_element(modes_.begin(), modes_.end(), [&](const Mode& a, const Mode& b) {
        return log_of(a) < log_of(b);
      }));
  std::vector<double> weights;
  double sum = 0.0;
  for (const Mode& mode : modes_) {
    sum += weights.emplace_back(mode.weight * portable::exp(log_of(mode) - best));
  }
  log_likelihood_ = best;
  if (!(sum > 0.0 && std::isfinite(sum))) return;  // none has foreseen it
  for (std::size_t i = 0; i < modes_.size(); ++i) modes_[i].weight = weights[i] / sum;
  log_likelihood_ += portable::log(sum);
}

template <int D>
void ImmFilter<D>::coast() {
  residual_.reset();
  ++misses_;
}

/// The mean and the covariance of the mixture of all modes, and the leader, which stays while no
/// other mode is likelier.
template <int D>
void ImmFilter<D>::combine() {
  estimate_ = {};
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    const double weight = modes_[i].weight;
    const Kinematics<D>& of_mode = modes_[i].filter.estimate();
    estimate_.position += weight * of_mode.position;
    estimate_.velocity += weight * of_mode.velocity;
    estimate_.acceleration += weight * of_mode.acceleration;
    if (weight > modes_[leader_].weight) leader_ = i;
  }
  covariance_.setZero();
  for (const Mode& mode : modes_) {
    const Vector d = mode.filter.estimate().position - estimate_.position;
    covariance_ += mode.weight *
                   (mode.filter.innovation_covariance(Matrix::Zero()) + Matrix(d * d.transpose()));
  }
}

template class ImmFilter<1>;
template class ImmFilter<2>;

}  // namespace ghtrack
