#include "tests/tools/render/synthetic_scene.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace ghtrack::render {

namespace {

constexpr double kRate = 30.0;  // [Hz]
constexpr double kNoise = 0.5;  // [m]
constexpr double kGravity = 9.80665;
constexpr int kBalls = 5;
constexpr int kBalloons = 3;

struct Gains {
  const char* name;
  double g, h;
};
constexpr std::array<Gains, 6> kGains{{{"balanced", 0.4, 0.1},
                                       {"nimble", 0.8, 0.4},
                                       {"sluggish", 0.08, 0.003},
                                       {"steady", 0.2, 0.02},
                                       {"quick", 0.6, 0.2},
                                       {"lazy", 0.05, 0.001}}};

Vec2 point_on_slope(double way) { return {150.0 - way * 0.96, 8.0 + way * 0.28}; }

}  // namespace

SyntheticScene::SyntheticScene(int panels)
    : filters_(static_cast<std::size_t>(panels)),
      squared_error_(static_cast<std::size_t>(panels)),
      errors_(static_cast<std::size_t>(panels)) {
  drawing_.title = "Three regimes";
  drawing_.seed = 7;
  drawing_.duration = 10.0;
  drawing_.world = Rectangle{Vec2(-10.0, -6.0), Vec2(170.0, 72.0)};
  drawing_.ground = Ground{};
  drawing_.walls = {Wall{.from = Vec2(140.0, 0.0), .to = Vec2(140.0, 12.0)}};
  drawing_.rails = {{Vec2(-40.0, 1.4), Vec2(200.0, 1.4)},
                    {point_on_slope(-20.0), point_on_slope(180.0)}};
  drawing_.sensors = {{"camera",
                       kRate,
                       std::nullopt,
                       {Vec2(-5.0, -3.0), Vec2(165.0, -3.0), Vec2(165.0, 70.0), Vec2(-5.0, 70.0)},
                       true}};
  drawing_.wind = [](const Vec2& place, double) { return Vec2(3.0 + 0.05 * place.y(), 0.0); };
  drawing_.strongest_wind = 6.0;
  const auto add = [&](const std::string& name, const std::string& regime, Outline outline) {
    drawing_.objects.push_back(
        {static_cast<ObjectId>(drawing_.objects.size()), name, regime, regime, 0, outline});
  };
  add("express", "train", {Outline::Shape::kBox, 12.0, 2.9});
  add("climber", "train", {Outline::Shape::kBox, 12.0, 2.9});
  for (int i = 0; i < kBalls; ++i)
    add("ball " + std::to_string(i + 1), "ball", {Outline::Shape::kDisc, 0.22, 0.22});
  for (int i = 0; i < kBalloons; ++i)
    add("balloon " + std::to_string(i + 1), "balloon", {Outline::Shape::kBalloon, 1.2, 1.2});
  for (int i = 0; i < panels; ++i) {
    const Gains& gains = kGains[static_cast<std::size_t>(i)];
    drawing_.panels.push_back({gains.name, "g " + std::to_string(gains.g).substr(0, 4) + "  h " +
                                               std::to_string(gains.h).substr(0, 5)});
  }
}

TruthSnapshot SyntheticScene::truth(double time) const {
  TruthSnapshot truth;
  truth.time = time;
  const auto add = [&](ObjectId id, const Vec2& position, const Vec2& velocity) {
    truth.objects.push_back({id, position, velocity, Vec2::Zero()});
  };
  const double head = -10.0 + 16.0 * time;
  for (int car = 0; car < 4; ++car) truth.bodies.push_back({0, Vec2(head - 12.6 * car, 3.0), 0.0});
  add(0, {head - 18.9, 3.0}, {16.0, 0.0});
  const double way = 10.0 + 11.0 * time;
  const Vec2 along(-0.96, 0.28);
  const Vec2 above(0.28, 0.96);
  for (int car = 0; car < 3; ++car)
    truth.bodies.push_back(
        {1, point_on_slope(way - 12.6 * car) + 1.6 * above, std::atan2(along.y(), along.x())});
  add(1, point_on_slope(way - 12.6) + 1.6 * above, 11.0 * along);
  for (int i = 0; i < kBalls; ++i) {
    const double since = time - 0.7 * i;
    if (since < 0.0) continue;
    const double up = 22.0 + 2.0 * i;
    const double flight = 2.0 * up / kGravity;
    const double bounces = std::floor(since / flight);
    const double t = since - bounces * flight;
    const double across = 7.0 + 2.5 * i;
    const Vec2 position(10.0 + 6.0 * i + across * since, up * t - 0.5 * kGravity * t * t);
    truth.bodies.push_back({2 + i, position, -6.0 * since});
    add(2 + i, position, {across, up - kGravity * t});
  }
  for (int i = 0; i < kBalloons; ++i) {
    const double phase = 0.8 * time + 2.0 * i;
    const Vec2 position(30.0 + 22.0 * i + 3.0 * time + 2.0 * std::sin(phase),
                        6.0 + 5.0 * i + 4.0 * time + std::cos(1.3 * phase));
    truth.bodies.push_back({2 + kBalls + i, position, 0.0});
    add(2 + kBalls + i, position, {3.0 + 1.6 * std::cos(phase), 4.0 - 1.3 * std::sin(1.3 * phase)});
  }
  return truth;
}

double SyntheticScene::uniform() {  // xorshift (Marsaglia 2003)
  random_ ^= random_ << 13;
  random_ ^= random_ >> 7;
  random_ ^= random_ << 17;
  return static_cast<double>(random_ >> 11) * 0x1.0p-53;
}

double SyntheticScene::normal() {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += uniform();
  return sum;
}

VideoFrame SyntheticScene::next() {
  VideoFrame frame;
  frame.time = static_cast<double>(scans_) / kRate;
  frame.truth = truth(frame.time);
  frame.scans = ++scans_;
  Observation observation;
  observation.scan.time = frame.time;
  std::map<ObjectId, std::size_t> seen;
  for (const TruthState& object : frame.truth.objects) {
    const bool is_hidden = object.id == 4 && frame.time > 4.0 && frame.time < 4.8;
    const bool is_inside = object.position.x() > -5.0 && object.position.x() < 165.0;
    if (is_hidden || !is_inside || uniform() > 0.95) continue;
    Detection detection;
    const double x = object.position.x() + kNoise * normal();
    const double y = object.position.y() + kNoise * normal();
    detection.position = {x, y};
    detection.label = drawing_.objects[static_cast<std::size_t>(object.id)].label;
    seen[object.id] = observation.scan.detections.size();
    observation.scan.detections.push_back(detection);
    observation.origins.push_back(object.id);
  }
  for (int i = 0; i < 3; ++i) {
    Detection detection;
    const double x = -5.0 + 170.0 * uniform();
    const double y = -3.0 + 73.0 * uniform();
    detection.position = {x, y};
    observation.scan.detections.push_back(detection);
    observation.origins.push_back(kClutterOrigin);
  }

  for (std::size_t panel = 0; panel < filters_.size(); ++panel) {
    PanelFrame shown;
    ScanReport report;
    report.tracks.time = frame.time;
    auto& filters = filters_[panel];
    for (const TruthState& object : frame.truth.objects) {
      const auto found = seen.find(object.id);
      const bool is_seen = found != seen.end();
      if (is_seen || filters.contains(object.id))
        update(filters[object.id], static_cast<int>(panel),
               is_seen ? std::optional(found->second) : std::nullopt, observation.scan);
      const auto filter = filters.find(object.id);
      if (filter == filters.end()) continue;
      if (filter->second.misses > 20) {
        filters.erase(filter);
        continue;
      }
      report.tracks.tracks.push_back(filter->second.track);
      const double error = (filter->second.track.position - object.position).norm();
      if (filter->second.track.status != TrackStatus::kTentative)
        report.pairings.push_back({object.id, filter->second.track.id, error});
      squared_error_[panel] += (filter->second.track.position - object.position).squaredNorm();
      ++errors_[panel];
    }
    if (errors_[panel] > 0) report.rmse = std::sqrt(squared_error_[panel] / errors_[panel]);
    shown.rmse = report.rmse;
    if (panel == 0) shown.gospa = 1.7;
    shown.tracks = report.tracks;
    shown.arrived = {report};
    frame.panels.push_back(shown);
  }
  frame.arrived.push_back(observation);
  frame.observations.push_back(std::move(observation));
  return frame;
}

void SyntheticScene::update(Filter& filter, int panel, std::optional<std::size_t> detection,
                            const Scan& scan) {
  const Gains& gains = kGains[static_cast<std::size_t>(panel)];
  TrackEstimate& track = filter.track;
  if (track.id == 0) {
    track.id = next_id_++;
    track.filter = "gh";
    track.label = scan.detections[*detection].label;
    track.position = scan.detections[*detection].position;
    track.prior_position = track.position;
  } else {
    track.prior_position = track.position + track.velocity / kRate;
  }
  track.innovation_covariance = 2.0 * kNoise * kNoise * Eigen::Matrix2d::Identity();
  track.innovation_covariance(0, 1) = track.innovation_covariance(1, 0) = 0.15;
  track.detection = detection;
  track.residual.reset();
  track.position = track.prior_position;
  if (detection) {
    ++filter.detections;
    filter.misses = 0;
    const Vec2 residual = scan.detections[*detection].position - track.prior_position;
    const double n = filter.detections;  // the growing-memory gains while the track is young
    const double g = std::max(gains.g, 2.0 * (2.0 * n - 1.0) / (n * (n + 1.0)));
    const double h = std::max(gains.h, n > 1.0 ? 6.0 / (n * (n + 1.0)) : 0.0);
    track.position += std::min(1.0, g) * residual;
    track.velocity += std::min(1.0, h) * kRate * residual;
    track.residual = residual;
  } else {
    ++filter.misses;
  }
  track.status = filter.misses > 0       ? TrackStatus::kCoasting
                 : filter.detections < 3 ? TrackStatus::kTentative
                                         : TrackStatus::kConfirmed;
}

}  // namespace ghtrack::render
