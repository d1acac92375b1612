#include "tools/metrics/expected_error.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include "sim/portable_math.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr double kSmall = 0.1;  // of a sigma: so far beside the prediction no limit is near
constexpr int kSettled = 5;     // updates after which filters with a limit use it

using Vector6 = ExpectedError::Vector6;
using Matrix6 = ExpectedError::Matrix6;
using Gain = ExpectedError::Gain;
constexpr std::size_t kShadows = ExpectedError::kShadows;

Vector6 state_of(const Filter& filter) {
  const Kinematics<2>& state = estimate(filter);
  Vector6 all;
  all << state.position, state.velocity, state.acceleration;
  return all;
}

/// F P Fᵀ of motion under constant acceleration: what a filter does not carry has no covariance.
void extrapolate(Matrix6& p, double dt) {
  p.topRows<2>() += dt * p.middleRows<2>(2) + (0.5 * dt * dt) * p.bottomRows<2>();
  p.middleRows<2>(2) += dt * p.bottomRows<2>();
  p.leftCols<2>() += dt * p.middleCols<2>(2) + (0.5 * dt * dt) * p.rightCols<2>();
  p.middleCols<2>(2) += dt * p.rightCols<2>();
}

/// (I − K H) P (I − K H)ᵀ + K R Kᵀ. Rows and columns are taken on their own: with one for the
/// other, what rounding has made unsymmetric in P would grow by I + K H.
void correct(Matrix6& p, const Gain& gain, const Eigen::Matrix2d& r) {
  const Gain columns = p.leftCols<2>();
  const Eigen::Matrix<double, 2, 6> rows = p.topRows<2>();
  const Eigen::Matrix2d s = columns.topRows<2>() + r;
  p -= gain * rows;
  p -= columns * gain.transpose();
  p += (gain * s) * gain.transpose();
}

/// What the sensor would measure at a place, with the accuracy of the detection.
std::optional<ExpectedMeasurement> shown(const SensedDetection& used, const Vec2& place) {
  return expected_measurement(used.sensor, used.errors, place, used.detection);
}

/// The same without any noise, and not rounded.
std::optional<Detection> noiseless(const SensedDetection& used, const Vec2& place) {
  std::optional<Detection> detection = noiseless_detection(used.sensor, place);
  if (!detection) return std::nullopt;
  detection->covariance = used.detection.covariance;
  if (detection->measured && used.detection.measured) {
    detection->measured->r = used.detection.measured->r;
  }
  return detection;
}

/// A detection of the sensor with noise of its own.
std::optional<Detection> noisy(const SensedDetection& used, const Vec2& place, Stream& stream) {
  double ticket = stream.uniform();
  double factor = used.errors.back().variance_factor;
  for (const ErrorPart& part : used.errors) {
    if (ticket < part.probability) {
      factor = part.variance_factor;
      break;
    }
    ticket -= part.probability;
  }
  Vec2 error;
  error.x() = stream.normal();
  error.y() = stream.normal();
  return std::visit(
      [&](const auto& model) {
        return model.measure(place, used.sensor.site, std::sqrt(factor) * error);
      },
      used.sensor.model);
}

/// Whether answers depend on the noise but by a limit.
bool learns_from_noise(const MotionFilter<2>& filter) {
  return !std::holds_alternative<PolynomialMotion>(filter.motion());
}
bool learns_from_noise(const MultipleModelFilter<2>&) { return true; }
bool learns_from_noise(const ImmFilter<2>&) { return true; }
bool learns_from_noise(const auto&) { return false; }

/// A filter after some measurements of its own accuracy, about to take another.
class SettledFilter {
 public:
  explicit SettledFilter(const Filter& fresh)
      : filter_(fresh), sigma_(std::visit([](const auto& f) { return f.sigma(); }, fresh)) {
    constexpr double kInterval = 1.0;  // any will do [s]
    start(filter_, Vec2::Zero(), accuracy(1.0));
    for (int i = 0; i < kSettled; ++i) {
      predict(filter_, kInterval);
      update(filter_, Vec2::Zero(), accuracy(1.0));
    }
    predict(filter_, kInterval);
  }

  /// How far it moves towards a residual; both of these in sigmas of its own.
  double answer_to(double residual, double error) const {
    Filter moved = filter_;
    update(moved, Vec2(residual * sigma_, 0.0), accuracy(error));
    return estimate(moved).position.x();
  }

 private:
  Eigen::Matrix2d accuracy(double error) const {
    return error * error * sigma_ * sigma_ * Eigen::Matrix2d::Identity();
  }

  Filter filter_;
  double sigma_;
};

/// Whether a filter that has settled answers a residual of 100 sigma by less than in proportion.
bool has_limit(const Filter& fresh) {
  const SettledFilter filter(fresh);
  return filter.answer_to(100.0, 1.0) < 500.0 * filter.answer_to(kSmall, 1.0);
}

/// Whether it answers what is said to be more accurate by more.
bool heeds_accuracy(const Filter& fresh) {
  const SettledFilter filter(fresh);
  return filter.answer_to(kSmall, 0.5) != filter.answer_to(kSmall, 1.0);
}

/// As a Stream's step: so many numbers apart for each shadow.
std::uint64_t step_of(int updates, std::size_t shadow) {
  return static_cast<std::uint64_t>(updates) * kShadows + shadow;
}

}  // namespace

ExpectedError::ExpectedError(const Filter& fresh, const TruthState& truth,
                             const SensedDetection& first, double time, std::uint64_t key,
                             Noise noise)
    : time_(time),
      filter_(fresh),
      is_linear_(has_own_gains(fresh) && !(noise == Noise::kTurning && heeds_accuracy(fresh))),
      shadows_(is_linear_ && noise == Noise::kNormal ? 0 : kShadows, fresh),
      key_(key) {
  const std::optional<ExpectedMeasurement> seen = shown(first, truth.position);
  is_known_ = seen && !first.errors.empty();
  if (!is_known_) return;
  const Detection& mean = seen->mean;
  start(filter_, mean.position, mean.covariance);
  covariance_.topLeftCorner<2, 2>() = seen->covariance;
  echoes_(0, 0) = covariance_(0, 0);
  for (std::size_t i = 0; i < shadows_.size(); ++i) {
    Stream stream(0, Purpose::kResampling, key_, step_of(0, i));
    const Detection detection = noisy(first, truth.position, stream).value_or(mean);
    start(shadows_[i], detection.position, detection.covariance);
  }
}

void ExpectedError::advance(const TruthState& truth, double time,
                            const std::optional<SensedDetection>& used) {
  if (!is_known_) return;
  if (time > time_) {
    const double dt = time - time_;
    predict(filter_, dt);
    for (Matrix6* p : {&covariance_, &echoes_, &residual_echoes_}) extrapolate(*p, dt);
    for (Filter& shadow : shadows_) predict(shadow, dt);
  }
  time_ = time;
  innovation_.reset();
  if (!used) {
    coast(filter_);
    for (Filter& shadow : shadows_) coast(shadow);
  } else {
    if (is_linear_) update(truth, *used);
    if (!is_known_) return;
    if (!shadows_.empty()) update_shadows(truth, *used);
    ++updates_;
  }
  if (const double variance = covariance_(0, 0); is_linear_ && variance > 0.0) {
    const Vector6 u = covariance_.col(0) / std::sqrt(variance);
    echoes_ += u * u.transpose();
  }
}

/// The gain is how the answer changes with the measurement; one that is expected changes nothing.
void ExpectedError::update(const TruthState& truth, const SensedDetection& used) {
  const std::optional<ExpectedMeasurement> seen = shown(used, truth.position);
  is_known_ = seen && !used.errors.empty();
  if (!is_known_) return;
  const Vec2 predicted = estimate(filter_).position;
  const Eigen::Matrix2d& told = used.detection.covariance;
  const double step = kSmall * std::sqrt(told.trace());
  const auto answer_to = [&](const Detection& detection) -> Vector6 {
    Filter moved = filter_;
    ghtrack::update(moved, detection);
    return state_of(moved) - state_of(filter_);
  };
  const auto beside = [&](const Vec2& offset) {
    return Detection{.position = predicted + offset, .covariance = told, .label = {}};
  };
  Gain gain = Gain::Zero();
  if (!used.detection.measured && told(0, 1) == 0.0) {  // the axes have nothing to do with another
    const Vector6 both = answer_to(beside({step, step})) / step;
    for (int row = 0; row < 6; ++row) gain(row, row % 2) = both[row];
  } else if (!used.detection.measured) {
    gain << answer_to(beside({step, 0.0})) / step, answer_to(beside({0.0, step})) / step;
  } else {
    const auto here = noiseless(used, predicted);
    const auto right = noiseless(used, predicted + Vec2(step, 0.0));
    const auto above = noiseless(used, predicted + Vec2(0.0, step));
    is_known_ = here && right && above;
    if (!is_known_) return;
    const Vector6 still = answer_to(*here);  // no zero where the sensor has a bias
    gain << (answer_to(*right) - still) / step, (answer_to(*above) - still) / step;
  }
  const Eigen::Matrix2d position = covariance_.topLeftCorner<2, 2>();
  const Eigen::Matrix2d& noise = seen->covariance;
  const Eigen::Matrix2d s = position + noise;
  const Vec2 residual = seen->mean.position - predicted;
  innovation_ = {.mean = residual,
                 .covariance = s,
                 .length = shadows_.empty() ? expected_length(residual, s) : 0.0,  // they tell
                 .memory = 1.0 + residual_echoes_(0, 0) / s(0, 0)};
  const Vector6 left = (covariance_.leftCols<2>() - gain * s).col(0) / std::sqrt(s(0, 0));
  ghtrack::update(filter_, seen->mean);
  correct(covariance_, gain, noise);
  correct(echoes_, gain, Eigen::Matrix2d::Zero());
  correct(residual_echoes_, gain, Eigen::Matrix2d::Zero());
  residual_echoes_ += left * left.transpose();
}

void ExpectedError::update_shadows(const TruthState& truth, const SensedDetection& used) {
  Value::Innovation seen;
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < shadows_.size(); ++i) {
    Stream stream(0, Purpose::kResampling, key_, step_of(updates_, i));
    const std::optional<Detection> detection = noisy(used, truth.position, stream);
    is_known_ = detection && !used.errors.empty();
    if (!is_known_) return;
    const Vec2 residual = detection->position - estimate(shadows_[i]).position;
    constexpr double kShare = 1.0 / kShadows;
    seen.mean += kShare * residual;
    seen.length += kShare * residual.norm();
    squares += kShare * residual * residual.transpose();
    ghtrack::update(shadows_[i], *detection);
  }
  seen.covariance = squares - seen.mean * seen.mean.transpose();
  if (is_linear_) {
    innovation_->length = seen.length;
  } else {
    innovation_ = seen;
  }
}

ExpectedError::Value ExpectedError::value(const TruthState& truth) const {
  if (!is_linear_) return value_of_shadows(truth);
  const Kinematics<2>& mean = estimate(filter_);
  const double variance = covariance_(0, 0);
  return {.position = mean.position - truth.position,
          .position_variance = covariance_.topLeftCorner<2, 2>().trace(),
          .velocity = mean.velocity - truth.velocity,
          .velocity_variance = covariance_.block<2, 2>(2, 2).trace(),
          .innovation = innovation_,
          .memory = variance > 0.0 ? std::max(1.0, echoes_(0, 0) / variance) : 1.0};
}

ExpectedError::Value ExpectedError::value_of_shadows(const TruthState& truth) const {
  constexpr double kShare = 1.0 / kShadows;
  Value value{.innovation = innovation_};
  std::array<Value::Shadow, kShadows> squares;
  for (std::size_t i = 0; i < kShadows; ++i) {
    const Vec2 position = estimate(shadows_[i]).position - truth.position;
    const Vec2 velocity = estimate(shadows_[i]).velocity - truth.velocity;
    squares[i] = {position.squaredNorm(), velocity.squaredNorm()};
    value.position += kShare * position;
    value.velocity += kShare * velocity;
    value.position_variance += kShare * position.squaredNorm();
    value.velocity_variance += kShare * velocity.squaredNorm();
  }
  value.position_variance -= value.position.squaredNorm();
  value.velocity_variance -= value.velocity.squaredNorm();
  value.shadows = squares;
  return value;
}

bool has_own_gains(const Filter& filter) {
  return !std::visit([](const auto& f) { return learns_from_noise(f); }, filter) &&
         !has_limit(filter);
}

double expected_length(const Vec2& mean, const Eigen::Matrix2d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  const Eigen::Array2d variance = axes.eigenvalues().cwiseMax(0.0);
  const Eigen::Array2d squared = (axes.eigenvectors().transpose() * mean).cwiseAbs2();
  const double scale = squared.sum() + variance.sum();
  if (!(scale > 0.0)) return 0.0;
  // With t = e^u / scale the integrand falls as e^(-|u| / 2): trapezoids in u converge quickly.
  constexpr double kStep = 1.0;
  constexpr int kFarthest = 18;  // steps from 0
  static const std::array<double, 2 * kFarthest + 1> powers = [] {
    std::array<double, 2 * kFarthest + 1> all{};
    for (int i = -kFarthest; i <= kFarthest; ++i) all[i + kFarthest] = portable::exp(i * kStep);
    return all;
  }();
  double sum = 0.0;
  for (const double power : powers) {
    const double t = power / scale;
    const Eigen::Array2d widened = 1.0 + 2.0 * t * variance;
    const double kept = portable::exp(-(t * squared / widened).sum()) / std::sqrt(widened.prod());
    sum += (1.0 - kept) / std::sqrt(t);
  }
  return sum * kStep / (2.0 * std::sqrt(std::numbers::pi));
}

}  // namespace ghtrack
