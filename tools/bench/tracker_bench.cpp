#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tools/data/scan_reader.hpp"
#include "tracker/boxes/box_tracker.hpp"
#include "tracker/tracker.hpp"

// The whole tracker, scan by scan, on one core.

namespace ghtrack::bench {
namespace {

constexpr double kSigma = 2.0;            // [m]
constexpr double kSpeed = 2.0;            // 1-sigma velocity per axis [m/s]
constexpr double kSeen = 0.95;            // detection probability
constexpr double kTargetsPerArea = 2e-4;  // as in set A with 200 targets [1/m²]

/// Tracks that live by their probability of existence; the sensor says what it sees.
TrackerDesign design(const FilterConfig& filter, Association association) {
  TrackerConfig config;
  config.association = association;
  config.life_cycle = LifeCycle::kExistence;
  config.filters["default"] = filter;
  return {config,
          {{.period = 1.0,
            .sigma = kSigma,
            .field_of_view =
                Eigen::AlignedBox2d(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1000.0, 1000.0)),
            .detection_probability = kSeen,
            .clutter = 10.0}}};
}

/// Tracks that live by counts of hits and misses.
TrackerDesign design(const FilterConfig& filter) {
  TrackerConfig config;
  config.gate = 3.0;
  config.confirm = HitRule{.hits = 3, .scans = 64};
  config.drop_tentative = MissRule{.misses = 2, .scans = 2};
  config.drop_confirmed = MissRule{.misses = 4, .scans = 4};
  config.filters["default"] = filter;
  return {config, {{.period = 1.0, .sigma = kSigma, .field_of_view = {}}}};
}

FilterConfig kalman() {
  KalmanCvConfig filter;
  filter.model.emplace<process::WhiteNoise<1>>().spectral_density = 0.05;
  filter.initial_speed = 3.0;
  return filter;
}

FilterConfig gh() {
  GhConfig filter;
  filter.design = gain_design::TrackingIndex<1>{.process_noise = std::sqrt(0.05),
                                                .model = ProcessModel::kWhiteNoise};
  filter.initial_speed = 3.0;
  return filter;
}

/// Scenario set A: 100 scans from the first to the last, births and deaths included.
void set_a(benchmark::State& state, const TrackerDesign& tracker) {
  const std::string name = "A_n" + std::to_string(state.range(0)) + "_detections.csv";
  std::vector<Scan> scans = read_detections_csv(std::filesystem::path(GHTRACK_SOURCE_DIR) /
                                                "tests/reference/tracking" / name)
                                .scans;
  for (Scan& scan : scans) {
    for (Detection& detection : scan.detections) {
      detection.covariance = kSigma * kSigma * Eigen::Matrix2d::Identity();
    }
  }
  std::size_t tracks = 0;
  for (auto _ : state) {
    TrackerState tracked;
    for (const Scan& scan : scans) {
      tracked = step(tracker, std::move(tracked), scan);
      tracks += tracked.tracks.size();
    }
    benchmark::DoNotOptimize(tracked);
  }
  const auto steps = static_cast<double>(scans.size());
  state.counters["scans/s"] =
      benchmark::Counter(steps, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["tracks"] = static_cast<double>(tracks) / steps /
                             static_cast<double>(std::max<std::int64_t>(1, state.iterations()));
}

/// Targets in steady motion at constant density, seen in random order.
class Crowd {
 public:
  Crowd(int targets, double clutter) : clutter_(clutter) {
    side_ = std::sqrt(targets / kTargetsPerArea);
    std::normal_distribution<double> speed(0.0, kSpeed);
    for (int i = 0; i < targets; ++i) {
      const double x = place();
      const double y = place();
      positions_.emplace_back(x, y);
      const double vx = speed(random_);
      const double vy = speed(random_);
      velocities_.emplace_back(vx, vy);
    }
  }

  Scan next() {
    std::normal_distribution<double> noise(0.0, kSigma);
    std::bernoulli_distribution seen(kSeen);
    Scan scan{.time = time_, .sensor = 0, .detections = {}};
    const auto report = [&](double x, double y) {
      scan.detections.push_back({.position = {x, y},
                                 .covariance = kSigma * kSigma * Eigen::Matrix2d::Identity(),
                                 .label = {}});
    };
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      positions_[i] += velocities_[i];
      const double dx = noise(random_);
      const double dy = noise(random_);
      if (seen(random_)) report(positions_[i].x() + dx, positions_[i].y() + dy);
    }
    const double false_ones = clutter_ * static_cast<double>(positions_.size());
    for (int i = 0; i < static_cast<int>(false_ones); ++i) {
      const double x = place();
      const double y = place();
      report(x, y);
    }
    std::shuffle(scan.detections.begin(), scan.detections.end(), random_);
    time_ += 1.0;
    return scan;
  }

 private:
  double place() { return std::uniform_real_distribution<double>(0.0, side_)(random_); }

  std::mt19937_64 random_{1};
  double clutter_;  // false detections per target and scan
  double side_;     // [m]
  double time_ = 0.0;
  std::vector<Eigen::Vector2d> positions_, velocities_;
};

/// Time that this program has had a core for [s].
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Steady state after a few scans; how the cost grows with the number of targets.
void crowd(benchmark::State& state, const FilterConfig& filter, double clutter) {
  constexpr int kWarmUp = 6;
  const TrackerDesign tracker = design(filter);
  Crowd targets(static_cast<int>(state.range(0)), clutter);
  TrackerState tracked;
  for (int i = 0; i < kWarmUp; ++i) tracked = step(tracker, std::move(tracked), targets.next());
  double least = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const Scan scan = targets.next();
    const double begin = processor_seconds();
    tracked = step(tracker, std::move(tracked), scan);
    const double elapsed = processor_seconds() - begin;
    state.SetIterationTime(elapsed);
    least = std::min(least, elapsed / static_cast<double>(tracked.tracks.size()));
  }
  state.counters["tracks"] = static_cast<double>(tracked.tracks.size());
  state.counters["ns/track"] = 1e9 * least;
  // Cost of a track relative to the smallest crowd of this run: N^exponent in all.
  static double smallest_cost = 0.0;
  static double smallest = 0.0;
  const auto count = static_cast<double>(state.range(0));
  if (smallest == 0.0 || count <= smallest) {
    smallest = count;
    smallest_cost = least;
  } else {
    state.counters["exponent"] = 1.0 + std::log(least / smallest_cost) / std::log(count / smallest);
  }
}

/// Boxes of people who walk to and fro, one in ten missing.
std::vector<BoxScan> street(int people, int images) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 4.0);
  std::bernoulli_distribution seen(0.9);
  std::vector<BoxScan> scans;
  for (int i = 0; i < images; ++i) {
    BoxScan scan{.time = i + 1.0, .detections = {}};
    for (int person = 0; person < people; ++person) {
      const double phase = 0.02 * i + person;
      const double x = 320.0 + 250.0 * std::sin(phase) + noise(random);
      const double y = 60.0 * person + noise(random);
      const double width = 40.0 + noise(random);
      const double height = 110.0 + noise(random);
      if (seen(random)) scan.detections.push_back({.box = {{x, y}, {width, height}}});
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

void boxes(benchmark::State& state) {
  const std::vector<BoxScan> scans = street(static_cast<int>(state.range(0)), 500);
  const BoxTrackerConfig config;
  for (auto _ : state) {
    BoxTrackerState tracked;
    for (const BoxScan& scan : scans) tracked = step(config, std::move(tracked), scan);
    benchmark::DoNotOptimize(tracked);
  }
  state.counters["images/s"] = benchmark::Counter(static_cast<double>(scans.size()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK_CAPTURE(set_a, kalman, design(kalman()))->Arg(10)->Arg(50)->Arg(100)->Arg(200);
BENCHMARK_CAPTURE(set_a, gh, design(gh()))->Arg(10)->Arg(50)->Arg(100)->Arg(200);
BENCHMARK_CAPTURE(set_a, existence, design(gh(), Association::kNearestGlobal))->Arg(200);
BENCHMARK_CAPTURE(set_a, existence_kalman, design(kalman(), Association::kNearestGlobal))->Arg(200);
BENCHMARK_CAPTURE(set_a, probabilistic, design(gh(), Association::kProbabilistic))->Arg(200);
BENCHMARK_CAPTURE(set_a, probabilistic_kalman, design(kalman(), Association::kProbabilistic))
    ->Arg(200);
BENCHMARK_CAPTURE(set_a, multi_scan, design(gh(), Association::kMultiScan))->Arg(200);
BENCHMARK_CAPTURE(crowd, gh, gh(), 0.0)
    ->Arg(1'000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(crowd, gh_in_clutter, gh(), 0.25)
    ->Arg(10'000)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(boxes)->Arg(6)->Arg(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ghtrack::bench
