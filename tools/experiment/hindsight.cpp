#include "tools/experiment/hindsight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>

#include "tools/experiment/even_objects.hpp"
#include "tools/experiment/gain_search.hpp"
#include "tools/experiment/lanes.hpp"
#include "tools/experiment/parallel.hpp"
#include "tools/metrics/expected_error.hpp"
#include "tracker/filters/axis_covariance.hpp"
#include "tracker/filters/gains/analysis.hpp"
#include "tracker/filters/gains/rules.hpp"

namespace ghtrack {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::infinity();
constexpr double kDiffuse = 100.0;             // a start's uncertainty, in sigmas per period
constexpr double kMostLooks = 20'000.0;        // at all objects of a run
constexpr std::size_t kMostSmoothed = 20'000;  // scans
constexpr std::size_t kMostShadowed = 4'000;   // with errors of all kinds

/// Along tracking indices from a target that hardly manoeuvres to one that does nothing else.
FoundNumber least_over_indices(const std::function<double(double)>& cost) {
  return least_cost_of_number(1e-6, 1e4, 16, 6, cost);
}

/// What an evaluation goes through: objects and what their sensors' errors are.
class Judge {
 public:
  Judge(const ObjectsOfRuns& objects, std::span<const SensorConfig> sensors,
        const RunMetricsOptions& scoring, const std::function<void()>& on_step)
      : objects_(objects),
        sensors_(sensors),
        scoring_(scoring),
        on_step_(on_step),
        design_(best_sensor(sensors)) {
    for (const SensorConfig& sensor : sensors) {
      const auto* position = std::get_if<PositionSensor>(&sensor.model);
      const auto parts = error_parts(sensor);
      errors_.push_back(parts.value_or(std::vector<ErrorPart>{}));
      has_variance_ = has_variance_ && parts;
      is_plain_ = is_plain_ && position != nullptr && position->bias.isZero() &&
                  !sensor.student_dof && sensor.outlier_probability == 0.0;
    }
    if (is_plain_) {
      even_ = EvenObjects::among(objects_, others_);
    } else {
      others_.assign(objects_.begin(), objects_.end());
    }
    std::size_t scans = 0;
    for (const LabelledObject* object : others_) {
      if (scans <= kMostSmoothed) lanes_.push_back(Lanes::of(*object));
      scans += object->scans.size();
    }
  }

  bool has_variance() const { return has_variance_; }

  /// The expected RMSE of a filter that has not started yet.
  double expected(const GainFilter<2>& filter) const {
    on_step_();
    Mean squares;
    if (even_) squares += even_->expected_error(filter);
    std::size_t scans = 0;
    for (const LabelledObject* object : others_) {
      if (is_plain_) {
        squares += expected_errors(filter, *object).position;
        continue;
      }
      squares += expected_errors(filter, *object, sensors_, errors_).position;
      if ((scans += object->scans.size()) > kMostShadowed) break;
    }
    return squares.root().value_or(kNoValue);
  }

  /// The same of a filter with these gains; they may be too small for rounding to leave them
  /// stable.
  double expected_of(const Gains& gains) const {
    return is_stable(gains) ? expected(with(gains)) : kNoValue;
  }

  /// The gains of a search as a filter of a scene has them.
  GainFilter<2> with(const Gains& gains) const {
    if (gains.order == 0) return manual<0>(gains);
    return gains.order == 1 ? manual<1>(gains) : manual<2>(gains);
  }

  /// What a filter assumes of a target at first sight, 1-sigma: velocity and acceleration.
  struct Start {
    double speed = 0.0;         // [sigmas per period]
    double acceleration = 0.0;  // [sigmas per period²]
  };

  /// Kalata's gains in the steady state, and Kalman's on the way there.
  template <int Order>
  GainFilter<2> kalman_like(double index, const Start& start) const {
    GainFilterConfig<Order> config;
    config.design = gain_design::TrackingIndex<Order>{.index = index};
    config.schedule = GainSource::kCovariance;
    config.initial_speed = start.speed * design_.sigma / design_.period;
    config.initial_acceleration =
        start.acceleration * design_.sigma / (design_.period * design_.period);
    return std::get<GainFilter<2>>(make_filter(config, design_.sigma, design_.period));
  }

  double raw() const {
    Mean squares;
    for (const LabelledObject* object : objects_) {
      for (const ObjectScan& scan : object->scans) {
        if (!scan.detection) continue;
        squares.add((scan.detection->position - scan.truth.position).squaredNorm());
      }
    }
    return squares.root().value_or(kNoValue);
  }

  /// RMSE of a smoother for motion of this tracking index; of white noise in the acceleration or in
  /// its derivative.
  template <int Order>
  double smoothed_error(double index) const {
    on_step_();
    KalmanConfig<Order> config;
    process::PiecewiseConstant noise;
    noise.process_noise = intensity_of_index(ProcessModel::kPiecewiseConstant, index,
                                             scoring_.sigma, scoring_.period);
    config.model = noise;
    config.initial_speed = kDiffuse * scoring_.sigma / scoring_.period;
    config.initial_acceleration = config.initial_speed / scoring_.period;
    const LaneMotion motion{.order = Order,
                            .noise_over =
                                [&](double dt) {
                                  return process_noise(ProcessModel::kPiecewiseConstant, Order,
                                                       noise.process_noise, dt, scoring_.period);
                                },
                            .spread = {0.0, config.initial_speed, config.initial_acceleration}};
    Mean squares;
    if (even_) squares += even_->lanes().smoothed_error(motion);
    std::size_t scans = 0;
    for (std::size_t i = 0; i < others_.size(); ++i) {
      squares += lanes_[i] ? lanes_[i]->smoothed_error(motion)
                           : smoothed_errors(config, scoring_, *others_[i]).position;
      if ((scans += others_[i]->scans.size()) > kMostSmoothed) break;
    }
    return squares.root().value_or(kNoValue);
  }

 private:
  template <int Order>
  GainFilter<2> manual(const Gains& gains) const {
    GainFilterConfig<Order> config;
    config.design = gain_design::Manual<Order>{gains.g, gains.h, gains.k};
    return std::get<GainFilter<2>>(make_filter(config, design_.sigma, design_.period));
  }

  const ObjectsOfRuns& objects_;
  std::span<const SensorConfig> sensors_;
  const RunMetricsOptions& scoring_;
  const std::function<void()>& on_step_;
  SensorTraits design_;  // that filters are made for
  std::vector<std::vector<ErrorPart>> errors_;
  std::optional<EvenObjects> even_;            // go through a filter together,
  std::vector<const LabelledObject*> others_;  // one by one
  std::vector<std::optional<Lanes>> lanes_;    // of others; none where their axes differ
  bool is_plain_ = true;
  bool has_variance_ = true;
};

/// The best fixed gains of an order: along Kalata's curve first, then off it.
FoundGains best_of_order(const Judge& judge, int order) {
  const FoundNumber on = least_over_indices(
      [&](double index) { return judge.expected_of(tracking_index_gains(order, index)); });
  const Gains start = tracking_index_gains(order, on.at);
  if (order == 0) return {start, on.cost};
  const FoundGains off =
      least_cost_near(start, [&](const Gains& gains) { return judge.expected_of(gains); });
  return off.cost < on.cost ? off : FoundGains{start, on.cost};
}

/// The best filter that starts as Kalman's: by its index first, then by what it assumes of the
/// start.
template <int Order>
FoundGains best_kalman_like(const Judge& judge) {
  constexpr int kStarts = 8, kSections = 3;
  Judge::Start start{.speed = kDiffuse, .acceleration = kDiffuse};
  const auto cost_of = [&](double index) {
    return judge.expected(judge.kalman_like<Order>(index, start));
  };
  const double index = least_over_indices(cost_of).at;
  for (double Judge::Start::*part : {&Judge::Start::speed, &Judge::Start::acceleration}) {
    if (Order == 1 && part == &Judge::Start::acceleration) break;
    const FoundNumber best =
        least_cost_of_number(1e-3, kDiffuse, kStarts, kSections, [&](double value) {
          start.*part = value;
          return cost_of(index);
        });
    start.*part = best.at;
  }
  const FoundNumber found = least_over_indices(cost_of);
  return {tracking_index_gains(Order, found.at), found.cost};
}

/// Of all orders, and of filters that start as Kalman's.
void find_best_gains(const Judge& judge, Hindsight& found) {
  double least = kNoValue;
  const auto keep = [&](const FoundGains& candidate) {
    if (!(candidate.cost < least)) return;
    least = candidate.cost;
    found.best = candidate.gains;
  };
  for (const int order : {0, 1, 2}) keep(best_of_order(judge, order));
  keep(best_kalman_like<1>(judge));
  keep(best_kalman_like<2>(judge));
  if (std::isfinite(least)) found.best_fixed_gains = least;
}

}  // namespace

SensorTraits best_sensor(std::span<const SensorConfig> sensors) {
  std::vector<SensorTraits> traits;
  for (const SensorConfig& sensor : sensors) traits.push_back(traits_of(sensor));
  return *std::min_element(traits.begin(), traits.end(), [](const auto& a, const auto& b) {
    return a.sigma * a.sigma * a.period < b.sigma * b.sigma * b.period;
  });
}

std::optional<Gains> best_gains(const ObjectsOfRuns& objects, std::span<const SensorConfig> sensors,
                                const RunMetricsOptions& scoring, int order,
                                const std::function<void()>& on_step) {
  const Judge judge(objects, sensors, scoring, on_step);
  if (objects.empty() || !judge.has_variance()) return std::nullopt;
  return best_of_order(judge, order).gains;
}

Hindsight in_hindsight(const ObjectsOfRuns& objects, std::span<const SensorConfig> sensors,
                       std::span<const std::optional<RandomMotion>> motions,
                       const RunMetricsOptions& scoring, const std::function<void()>& on_step) {
  const Judge judge(objects, sensors, scoring, on_step);
  Hindsight found;
  if (const double raw = judge.raw(); std::isfinite(raw)) found.raw = raw;
  if (!found.raw) return found;
  if (judge.has_variance()) find_best_gains(judge, found);
  found.crlb = posterior_bound(objects, sensors, motions);
  constexpr int kIndices = 10;
  constexpr int kSections = 2;
  const double least =
      std::min(least_cost_of_number(1e-4, 1e5, kIndices, kSections,
                                    [&](double at) { return judge.smoothed_error<1>(at); })
                   .cost,
               least_cost_of_number(1e-4, 1e5, kIndices, kSections, [&](double at) {
                 return judge.smoothed_error<2>(at);
               }).cost);
  if (std::isfinite(least)) found.smoother = least;
  return found;
}

std::vector<ObjectId> objects_for_hindsight(const WorldScene& scene, std::size_t objects) {
  double scans = 0.0;
  for (const SensorConfig& sensor : scene.sensors) scans += 1.0 + scene.duration * sensor.rate;
  if (scans * static_cast<double>(objects) > kMostLooks) return {};
  std::vector<ObjectId> all(objects);
  std::iota(all.begin(), all.end(), ObjectId{0});
  return all;
}

void add_hindsight(RunReport& report, const std::vector<LabelledObject>& objects,
                   const WorldScene& scene, const std::function<void()>& on_step) {
  const std::vector<std::optional<RandomMotion>> motions = random_motions(scene, Runs::kOne);
  in_parallel(objects.size(), 2, [&](std::size_t i) {
    const Hindsight found =
        in_hindsight({&objects[i]}, scene.sensors, motions, report.options, on_step);
    ObjectReport& object = report.objects[static_cast<std::size_t>(objects[i].id)];
    object.best_fixed_gains = found.best_fixed_gains;
    object.crlb = found.crlb;
    object.smoother = found.smoother;
  });
}

}  // namespace ghtrack
