#include "tracker/learning/motion_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostFixes = 2000;  // that a fit is based on
constexpr double k95 = 1.96;

/// Bounds of the squared tracking index q T³ / σ². Nothing steadier or nimbler can be told from
/// detections; a gentle pull towards the usual keeps a few of them from deciding it.
constexpr double kSteadiest = 1e-6;
constexpr double kNimblest = 1e4;
constexpr double kUsual = 1e-2;
constexpr double kOutOfBounds = -1e300;  // for ln p
constexpr double kSpreadOfUsual = 4.0;   // of its ln

/// What the innovations of one axis sum up to.
struct Innovations {
  double log_likelihood = 0.0;
  double squared = 0.0;  // Σ r² / S
  double speed = 0.0;    // Σ of the second moment of the velocity, once it is known
  int count = 0;
  int speeds = 0;
};

/// A Kalman filter on one axis, at a nearly constant velocity.
void run(const Path& path, int axis, const std::vector<double>& variance, double density,
         double initial_variance, Innovations& sum) {
  const auto noise = [&](const Fix& fix) {
    const double said = fix.variance[axis];
    return said > 0.0 ? said : variance[static_cast<std::size_t>(fix.sensor)];
  };
  const Fix& first = path.fixes.front();
  double x = first.position[axis], v = 0.0;
  double xx = noise(first), xv = 0.0, vv = initial_variance;
  for (std::size_t i = 1; i < path.fixes.size(); ++i) {
    const Fix& fix = path.fixes[i];
    const double dt = fix.time - path.fixes[i - 1].time;
    x += v * dt;
    xx += dt * (2.0 * xv + dt * vv) + density * dt * dt * dt / 3.0;
    xv += dt * vv + density * dt * dt / 2.0;
    vv += density * dt;
    const double s = xx + noise(fix);
    const double r = fix.position[axis] - x;
    sum.log_likelihood -= 0.5 * (portable::log(s) + r * r / s);
    sum.squared += r * r / s;
    ++sum.count;
    const double to_x = xx / s, to_v = xv / s;
    x += to_x * r;
    v += to_v * r;
    vv -= to_v * xv;
    xv -= to_v * xx;
    xx -= to_x * xx;
    if (i < 2) continue;
    sum.speed += v * v + vv;
    ++sum.speeds;
  }
}

/// Every so many of the paths are enough to base a fit on.
std::size_t stride_of(std::span<const Path> paths) {
  std::size_t fixes = 0;
  for (const Path& path : paths) fixes += path.fixes.size();
  return std::max<std::size_t>(1, fixes / kMostFixes);
}

/// One parameter, as its logarithm.
struct Parameter {
  double value = 0.0;
  double step = 0.0;
  double curvature = 0.0;  // −d²/dv² of ln p
  bool is_free = true;
};

class Fit {
 public:
  Fit(std::span<const Path> paths, const LearnedMotion& start, double interval, double step)
      : model_(start), interval_(interval) {
    for (const LearnedMotion::Noise& noise : start.noise) {
      parameters_.push_back(parameter(noise.x, 2.0, step));
      parameters_.push_back(parameter(noise.y, 2.0, step));
    }
    for (const auto& [label, density] : start.process_density) {
      classes_.push_back(label);
      parameters_.push_back(parameter(density, 1.0, 2.0 * step));
    }
    paths_.resize(classes_.size());
    const std::size_t stride = stride_of(paths);
    for (std::size_t i = 0; i < paths.size(); i += stride) {
      paths_[class_of(paths[i])].push_back(&paths[i]);
    }
    sums_.resize(classes_.size());
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      for (const int axis : {0, 1}) sums_[c][static_cast<std::size_t>(axis)] = sum(c, axis);
    }
    free_what_is_seen();
  }

  MotionFit best() {
    constexpr int kMostSweeps = 8;
    constexpr double kSettled = 0.04;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      double greatest = 0.0;
      for (std::size_t i = 0; i < parameters_.size(); ++i) {
        if (parameters_[i].is_free) greatest = std::max(greatest, improve(i));
      }
      if (greatest < kSettled) break;
    }
    return result();
  }

 private:
  /// @param power  2: a standard deviation, whose variance is meant
  static Parameter parameter(const Learned& learned, double power, double step) {
    return {
        .value = power * portable::log(learned.value), .step = step, .is_free = !learned.is_given};
  }

  std::size_t sensors() const { return model_.noise.size(); }
  std::size_t index_of_class(std::size_t c) const { return 2 * sensors() + c; }

  /// A parameter that no detection depends on stays as it is.
  void free_what_is_seen() {
    std::vector<bool> seen(sensors(), false);
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (paths_[c].empty()) parameters_[index_of_class(c)].is_free = false;
      for (const Path* path : paths_[c]) {
        for (const Fix& fix : path->fixes) {
          if (fix.variance.isZero(0.0)) seen[static_cast<std::size_t>(fix.sensor)] = true;
        }
      }
    }
    for (std::size_t s = 0; s < seen.size(); ++s) {
      if (seen[s]) continue;
      parameters_[2 * s].is_free = parameters_[2 * s + 1].is_free = false;
    }
  }

  Innovations sum(std::size_t c, int axis) const {
    std::vector<double> variance;
    for (std::size_t s = 0; s < sensors(); ++s) {
      variance.push_back(portable::exp(parameters_[2 * s + static_cast<std::size_t>(axis)].value));
    }
    const double density = portable::exp(parameters_[index_of_class(c)].value);
    const double initial = model_.initial_speed * model_.initial_speed;
    Innovations total;
    for (const Path* path : paths_[c]) run(*path, axis, variance, density, initial, total);
    return total;
  }

  /// Its own, or that of all which have none of their own.
  std::size_t class_of(const Path& path) const {
    const auto own = std::find(classes_.begin(), classes_.end(), path.label);
    const auto any = std::find(classes_.begin(), classes_.end(), TrackerConfig::kDefaultFilter);
    return static_cast<std::size_t>((own != classes_.end() ? own : any) - classes_.begin());
  }

  /// ln p of how usual the tracking index is; kOutOfBounds where nothing is told.
  double usual() const {
    double variance = 0.0;
    for (std::size_t s = 0; s < 2 * sensors(); ++s) variance += portable::exp(parameters_[s].value);
    variance /= 2.0 * static_cast<double>(sensors());
    double log_p = 0.0;
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      const double index = portable::exp(parameters_[index_of_class(c)].value) * interval_ *
                           interval_ * interval_ / variance;
      if (!(index > kSteadiest && index < kNimblest)) return kOutOfBounds;
      const double off = portable::log(index / kUsual) / kSpreadOfUsual;
      log_p -= 0.5 * off * off;
    }
    return log_p;
  }

  double total() const {
    double log_p = usual();
    for (const auto& axes : sums_) log_p += axes[0].log_likelihood + axes[1].log_likelihood;
    return log_p;
  }

  /// ln p with parameter i at another value, which stays.
  double at(std::size_t i, double value) {
    parameters_[i].value = value;
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (i >= 2 * sensors() && index_of_class(c) != i) continue;
      for (const int axis : {0, 1}) {
        if (i < 2 * sensors() && static_cast<int>(i % 2) != axis) continue;
        sums_[c][static_cast<std::size_t>(axis)] = sum(c, axis);
      }
    }
    return total();
  }

  /// Goes to the top of the parabola through three points, or to the best of them.
  /// @returns how far it went
  double improve(std::size_t i) {
    Parameter& p = parameters_[i];
    const double here = p.value;
    const double now = total();
    const double below = at(i, here - p.step);
    const double above = at(i, here + p.step);
    const double bend = below - 2.0 * now + above;
    double to = above > below ? p.step : -p.step;
    if (now >= std::max(below, above)) {
      const bool is_bounded = std::min(below, above) <= kOutOfBounds;
      p.curvature = is_bounded ? 0.0 : std::max(0.0, -bend / (p.step * p.step));
      to = bend < 0.0 ? 0.5 * p.step * (below - above) / bend : 0.0;
    }
    if (at(i, here + to) < now) {
      at(i, here);
      to = 0.0;
    }
    if (std::abs(to) < 0.9 * p.step) p.step *= 0.4;
    return std::abs(to);
  }

  static Learned learned(const Learned& before, const Parameter& p, double power) {
    if (!p.is_free) return before;
    const double value = portable::exp(p.value / power);
    const double spread = p.curvature > 0.0 ? k95 / std::sqrt(p.curvature) / power : 5.0;
    return {value, value * portable::exp(-std::min(5.0, spread)),
            value * portable::exp(std::min(5.0, spread)), false};
  }

  MotionFit result() const {
    MotionFit fit{.model = model_};
    for (std::size_t s = 0; s < sensors(); ++s) {
      LearnedMotion::Noise& noise = fit.model.noise[s];
      noise.x = learned(noise.x, parameters_[2 * s], 2.0);
      noise.y = learned(noise.y, parameters_[2 * s + 1], 2.0);
    }
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      Learned& density = fit.model.process_density[classes_[c]];
      density = learned(density, parameters_[index_of_class(c)], 1.0);
    }
    Innovations all;
    for (const auto& axes : sums_) {
      for (const Innovations& axis : axes) {
        all.squared += axis.squared;
        all.count += axis.count;
        all.speed += axis.speed;
        all.speeds += axis.speeds;
      }
    }
    fit.fixes = all.count / 2;
    if (all.count > 0) fit.nis = 2.0 * all.squared / all.count;
    if (all.speeds > 0) fit.model.initial_speed = std::sqrt(all.speed / all.speeds);
    return fit;
  }

  LearnedMotion model_;
  double interval_;
  std::vector<std::string> classes_;
  std::vector<std::vector<const Path*>> paths_;  // of each class
  std::vector<Parameter> parameters_;  // ln of variances on x and y of each sensor, of densities
  std::vector<std::array<Innovations, 2>> sums_;  // of each class and axis
};

}  // namespace

MotionFit fit_motion(std::span<const Path> paths, const LearnedMotion& start, double interval,
                     bool first) {
  return Fit(paths, start, interval, first ? 1.2 : 0.4).best();
}

}  // namespace ghtrack
