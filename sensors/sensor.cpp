#include "sensors/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "sensors/merging.hpp"
#include "sensors/occlusion.hpp"
#include "sensors/view_geometry.hpp"
#include "sim/portable_math.hpp"
#include "sim/random.hpp"

namespace ghtrack {
namespace {

constexpr double kLn2 = 0.6931471805599453;

std::string pick(const std::vector<std::string>& classes, Stream& stream) {
  if (classes.empty()) return {};
  const double ticket = stream.uniform() * static_cast<double>(classes.size());
  return classes[static_cast<std::size_t>(ticket)];
}

/// The class reported for an object: the right one, or with probability 1 − classify another.
std::string reported_class(double classify, const std::string& right,
                           std::vector<std::string> classes, Stream& stream) {
  if (classify == 0.0) return {};
  if (stream.uniform() < classify) return right;
  std::erase(classes, right);
  return classes.empty() ? right : pick(classes, stream);
}

double size_of(const Outline& outline) {
  return outline.shape == Outline::Shape::kBox ? std::sqrt(outline.length * outline.width)
                                               : outline.length;
}

/// The chance that an object in full view is detected.
///   Range: a Swerling 1 target is detected with ln P ∝ −1 / SNR where the signal is strong, and
///   the radar equation has SNR ∝ r⁻⁴ (Swerling 1960). Size: the target transfer probability
///   function of Johnson's criteria (Johnson 1958).
double detection_probability(const SensorConfig& sensor, const Vec2& position,
                             const Outline& outline) {
  double probability = sensor.detection_probability;
  if (sensor.half_range) {
    const double squared =
        (position - sensor.site).squaredNorm() / (*sensor.half_range * *sensor.half_range);
    probability *= portable::exp(-kLn2 * squared * squared);
  }
  if (sensor.half_size) {
    const double x = size_of(outline) / *sensor.half_size;
    probability *= x > 0.0 ? 1.0 / (1.0 + portable::pow(x, -2.7 - 0.7 * x)) : 0.0;
  }
  return probability;
}

/// Two independent standard normal errors as a pair of Student's t with a common scale. The radius
/// of a normal pair is √(2E), E exponential; that of the t pair is √(ν (e^(2E/ν) − 1)) (Bailey
/// 1994): the pair is stretched, and nothing more is drawn.
Vec2 with_heavy_tails(const Vec2& normal, double dof) {
  const double squared = normal.squaredNorm();
  if (squared == 0.0) return normal;
  return normal * std::sqrt(dof * (portable::exp(squared / dof) - 1.0) / squared);
}

Vec2 standard_error(const SensorConfig& sensor, std::uint64_t seed, std::uint64_t key,
                    std::uint64_t step) {
  Stream noise(seed, Purpose::kMeasurementNoise, key, step);
  Vec2 error;
  error.x() = noise.normal();
  error.y() = noise.normal();
  if (sensor.student_dof) error = with_heavy_tails(error, *sensor.student_dof);
  if (sensor.outlier_probability > 0.0) {
    Stream luck(seed, Purpose::kOutlier, key, step);
    if (luck.uniform() < sensor.outlier_probability) error *= sensor.outlier_scale;
  }
  return error;
}

std::vector<Sighting> detections_of_objects(const SensorConfig& sensor, std::uint64_t step,
                                            const TruthSnapshot& truth, const Setting& setting) {
  const FieldOfView view = sensor.view();
  const std::uint64_t sensor_key = key_of(sensor.name);
  std::vector<double> covered(setting.objects.size(), 0.0);
  if (sensor.occlusion) {
    covered = covered_fractions(truth, setting.objects, sensor.nearest_first);
  }
  std::vector<Sighting> sightings;
  for (const TruthState& state : truth.objects) {
    const auto id = static_cast<std::size_t>(state.id);
    const ObjectInfo& object = setting.objects[id];
    if (!contains(view, state.position)) continue;
    if (sensor.occlusion && covered[id] > *sensor.occlusion) continue;
    const std::uint64_t key = combine(sensor_key, object.key);
    Stream luck(setting.seed, Purpose::kDetection, key, step);
    if (luck.uniform() >= detection_probability(sensor, state.position, object.outline)) continue;
    const Vec2 error = standard_error(sensor, setting.seed, key, step);
    std::optional<Detection> detection = std::visit(
        [&](const auto& model) { return model.measure(state.position, sensor.site, error); },
        sensor.model);
    if (!detection) continue;
    Stream naming(setting.seed, Purpose::kLabel, key, step);
    detection->label = reported_class(sensor.classify, object.label, setting.classes, naming);
    sightings.push_back({std::move(*detection), state.id});
  }
  return sightings;
}

void add_clutter(const SensorConfig& sensor, std::uint64_t step, const Setting& setting,
                 std::vector<Sighting>& sightings) {
  const FieldOfView view = sensor.view();
  if (!(sensor.clutter > 0.0) || std::holds_alternative<Everywhere>(view)) return;
  Stream stream(setting.seed, Purpose::kClutter, key_of(sensor.name), step);
  for (int left = stream.poisson(sensor.clutter); left > 0; --left) {
    const double u = stream.uniform();
    const double v = stream.uniform();
    const Vec2 place = point_in(view, u, v);
    Detection detection = std::visit(
        [&](const auto& model) { return model.false_alarm(place, sensor.site); }, sensor.model);
    if (sensor.classify > 0.0) detection.label = pick(setting.classes, stream);
    sightings.push_back({std::move(detection), kClutterOrigin});
  }
}

}  // namespace

SensorTraits traits_of(const SensorConfig& sensor) {
  const double sigma =
      std::visit([](const auto& model) { return model.typical_sigma(); }, sensor.model);
  return {.period = 1.0 / sensor.rate,
          .sigma = sigma,
          .field_of_view = sensor.view(),
          .detection_probability = sensor.detection_probability,
          .clutter = sensor.clutter};
}

std::vector<SensorTraits> traits_of(const std::vector<SensorConfig>& sensors) {
  std::vector<SensorTraits> traits;
  for (const SensorConfig& sensor : sensors) traits.push_back(traits_of(sensor));
  return traits;
}

double scan_time(const SensorConfig& sensor, std::int64_t scan) {
  return sensor.phase + static_cast<double>(scan) / sensor.rate;
}

Observation observe(const SensorConfig& sensor, int sensor_index, std::int64_t scan,
                    const TruthSnapshot& truth, const Setting& setting) {
  const auto step = static_cast<std::uint64_t>(scan);
  std::vector<Sighting> sightings = detections_of_objects(sensor, step, truth, setting);
  add_clutter(sensor, step, setting, sightings);
  if (sensor.resolution > 0.0) sightings = merge_close(std::move(sightings), sensor.resolution);
  std::sort(sightings.begin(), sightings.end(), [](const Sighting& a, const Sighting& b) {
    const Vec2& p = a.detection.position;
    const Vec2& q = b.detection.position;
    return std::tie(p.x(), p.y(), a.origin) < std::tie(q.x(), q.y(), b.origin);
  });
  Observation observation{.scan = {.time = truth.time, .sensor = sensor_index, .detections = {}},
                          .origins = {}};
  observation.scan.detections.reserve(sightings.size());
  observation.origins.reserve(sightings.size());
  for (Sighting& sighting : sightings) {
    observation.scan.detections.push_back(std::move(sighting.detection));
    observation.origins.push_back(sighting.origin);
  }
  return observation;
}

}  // namespace ghtrack
