// Fuzzing of the tracker: scans at any times with any positions and covariances. Whatever comes,
// what the tracker says is finite, and the number of its tracks stays bounded by what it was shown.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "tracker/tracker.hpp"

namespace {

/// Takes values from the front of the fuzzer's bytes; zeros after their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  template <class Value>
  Value take() {
    Value value{};
    const std::size_t size = left_ < sizeof value ? left_ : sizeof value;
    std::memcpy(&value, data_, size);
    data_ += size;
    left_ -= size;
    return value;
  }
  bool any() const { return left_ > 0; }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// Usually something near, by a small number of bytes; sometimes any double.
double number(Bytes& bytes) {
  const auto kind = bytes.take<std::uint8_t>();
  if (kind < 32) return bytes.take<double>();
  return static_cast<double>(bytes.take<std::int16_t>()) / 256.0;
}

ghtrack::Scan scan_from(Bytes& bytes, double& time) {
  const auto kind = bytes.take<std::uint8_t>();
  if (kind >= 16) time += kind / 256.0;
  ghtrack::Scan scan;
  scan.time = kind < 8 ? bytes.take<double>() : time;
  scan.sensor = kind % 2;
  const int count = bytes.take<std::uint8_t>() % 12;
  for (int i = 0; i < count; ++i) {
    ghtrack::Detection detection;
    detection.position.x() = number(bytes);
    detection.position.y() = number(bytes);
    const auto shape = bytes.take<std::uint8_t>();
    if (shape < 16) {
      for (double& entry : detection.covariance.reshaped()) entry = bytes.take<double>();
    }
    if (shape % 4 == 1) detection.label = "ball";
    if (shape % 4 == 2) detection.label = "balloon";
    scan.detections.push_back(std::move(detection));
  }
  return scan;
}

ghtrack::TrackerDesign design_of(std::uint8_t choice) {
  ghtrack::TrackerConfig config;
  if (choice % 2 == 1) {
    config.filters["ball"] =
        ghtrack::GhkConfig{.design = ghtrack::gain_design::TrackingIndex<2>{.process_noise = 3.0}};
    config.filters["balloon"] =
        ghtrack::GhConfig{.design = ghtrack::gain_design::TrackingIndex<1>{.process_noise = 0.2}};
  }
  if (choice % 4 >= 2) config.association = ghtrack::Association::kNearestGreedy;
  ghtrack::SensorTraits sensor;
  sensor.period = 0.1;
  sensor.sigma = 0.5;
  return {config, {sensor, sensor}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const ghtrack::TrackerDesign design = design_of(bytes.take<std::uint8_t>());
  ghtrack::TrackerState state;
  double time = 0.0;
  std::size_t shown = 0;
  while (bytes.any()) {
    const ghtrack::Scan scan = scan_from(bytes, time);
    shown += scan.detections.size();
    state = ghtrack::step(design, std::move(state), scan);
    const ghtrack::TrackSnapshot now = ghtrack::snapshot(state);
    if (now.tracks.size() > shown) std::abort();
    for (const ghtrack::TrackEstimate& track : now.tracks) {
      const bool finite = track.position.allFinite() && track.velocity.allFinite() &&
                          track.acceleration.allFinite() && track.prior_position.allFinite() &&
                          track.sigma.allFinite();
      if (!finite) std::abort();
    }
  }
  return 0;
}
