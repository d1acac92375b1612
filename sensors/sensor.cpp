#include "sensors/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace ghtrack {
namespace {

/// The classes a detector can report, each once, in a fixed order.
std::vector<std::string> labels_of(const std::vector<ObjectInfo>& objects) {
  std::vector<std::string> labels;
  for (const ObjectInfo& object : objects) labels.push_back(object.label);
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

std::string pick(const std::vector<std::string>& labels, Stream& stream) {
  if (labels.empty()) return {};
  const double ticket = stream.uniform() * static_cast<double>(labels.size());
  return labels[static_cast<std::size_t>(ticket)];
}

/// The class reported for an object: the right one, or with probability 1 − classify another.
std::string reported_label(double classify, const std::string& right,
                           std::vector<std::string> labels, Stream& stream) {
  if (classify == 0.0) return {};
  if (stream.uniform() < classify) return right;
  std::erase(labels, right);
  return labels.empty() ? right : pick(labels, stream);
}

}  // namespace

SensorTraits traits_of(const SensorConfig& sensor) {
  const double sigma =
      std::visit([](const auto& model) { return model.typical_sigma(); }, sensor.model);
  return {.period = 1.0 / sensor.rate,
          .sigma = sigma,
          .field_of_view = box_between(sensor.field_of_view)};
}

double scan_time(const SensorConfig& sensor, std::int64_t scan) {
  return sensor.phase + static_cast<double>(scan) / sensor.rate;
}

Observation observe(const SensorConfig& sensor, int sensor_index, std::int64_t scan,
                    const TruthSnapshot& truth, const std::vector<ObjectInfo>& objects,
                    std::uint64_t seed) {
  const std::uint64_t sensor_key = key_of(sensor.name);
  const auto step = static_cast<std::uint64_t>(scan);
  const std::optional<Eigen::AlignedBox2d> view = box_between(sensor.field_of_view);
  const std::vector<std::string> labels = labels_of(objects);
  std::vector<std::pair<Detection, ObjectId>> found;

  for (const TruthState& state : truth.objects) {
    if (view && !view->contains(state.position)) continue;
    const ObjectInfo& object = objects[static_cast<std::size_t>(state.id)];
    const std::uint64_t key = combine(sensor_key, object.key);
    Stream luck(seed, Purpose::kDetection, key, step);
    if (luck.uniform() >= sensor.detection_probability) continue;
    Stream noise(seed, Purpose::kMeasurementNoise, key, step);
    Detection detection = std::visit(
        [&](const auto& model) { return model.measure(state.position, noise); }, sensor.model);
    Stream naming(seed, Purpose::kLabel, key, step);
    detection.label = reported_label(sensor.classify, object.label, labels, naming);
    found.emplace_back(std::move(detection), state.id);
  }

  if (view && sensor.clutter > 0.0) {
    Stream stream(seed, Purpose::kClutter, sensor_key, step);
    const auto count = stream.poisson(sensor.clutter);
    const double variance = std::pow(traits_of(sensor).sigma, 2);
    for (auto i = count; i > 0; --i) {
      const double across = stream.uniform();
      const double up = stream.uniform();
      Detection detection;
      detection.position = view->min() + Vec2(across, up).cwiseProduct(view->sizes());
      detection.covariance = variance * Eigen::Matrix2d::Identity();
      if (sensor.classify > 0.0) detection.label = pick(labels, stream);
      found.emplace_back(std::move(detection), kClutterOrigin);
    }
  }

  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    const Vec2& p = a.first.position;
    const Vec2& q = b.first.position;
    return std::tie(p.x(), p.y(), a.second) < std::tie(q.x(), q.y(), b.second);
  });
  Observation observation{.scan = {.time = truth.time, .sensor = sensor_index, .detections = {}},
                          .origins = {}};
  for (auto& [detection, origin] : found) {
    observation.scan.detections.push_back(std::move(detection));
    observation.origins.push_back(origin);
  }
  return observation;
}

}  // namespace ghtrack
