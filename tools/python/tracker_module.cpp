// `ghtrack._tracker`: the tracker for live use, scan by scan.

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/schema/configuration.hpp"
#include "scenes/schema/descriptions.hpp"
#include "tools/run/offline.hpp"
#include "tracker/tracker.hpp"

namespace py = pybind11;

namespace ghtrack {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The tracker of `ghtrack track`, fed by hand.
class LiveTracker {
 public:
  /// @param text    a configuration, as the file of `ghtrack track --config`
  /// @param period  nominal time between scans [s], unless the configuration has it
  LiveTracker(const std::string& text, std::optional<double> period)
      : config_(schema::read_configuration_text<OfflineConfig>(text, "configuration")),
        design_(config_.tracker, {traits(config_, period)}, {area_of(config_)}) {}

  /// @param positions    (n, 2) [m]
  /// @param covariances  (n, 2, 2) [m²], or empty: the configured noise
  /// @param labels       class of each detection, or empty
  /// @return whether the scan was used: one older than the last is refused
  bool step(double time, const Array& positions, const Array& covariances,
            const std::vector<std::string>& labels) {
    Scan scan{.time = time, .sensor = 0, .detections = detections(positions, covariances, labels)};
    const py::gil_scoped_release release;
    const std::int64_t refused = state_.scans_refused;
    state_ = ghtrack::step(design_, std::move(state_), scan);
    return state_.scans_refused == refused;
  }

  /// Columns by name, as in tracks.csv.
  py::dict tracks() const {
    const TrackSnapshot now = snapshot(state_);
    py::dict columns;
    const auto numbers = [&](const char* name, auto value) {
      py::array_t<double> column(static_cast<py::ssize_t>(now.tracks.size()));
      double* out = column.mutable_data();
      for (const TrackEstimate& track : now.tracks) *out++ = value(track);
      columns[name] = column;
    };
    const auto texts = [&](const char* name, auto value) {
      py::list column;
      for (const TrackEstimate& track : now.tracks)
        column.append(py::str(std::string(value(track))));
      columns[name] = column;
    };
    numbers("t", [&](const TrackEstimate&) { return now.time; });
    numbers("track_id", [](const TrackEstimate& track) { return track.id; });
    texts("status", [](const TrackEstimate& track) { return to_string(track.status); });
    texts("filter", [](const TrackEstimate& track) { return track.filter; });
    const auto vectors = [&](std::array<const char*, 2> names, auto value) {
      for (int axis : {0, 1}) {
        numbers(names[static_cast<std::size_t>(axis)],
                [&](const TrackEstimate& track) { return value(track)[axis]; });
      }
    };
    vectors({"x", "y"}, [](const TrackEstimate& track) { return track.position; });
    vectors({"vx", "vy"}, [](const TrackEstimate& track) { return track.velocity; });
    vectors({"ax", "ay"}, [](const TrackEstimate& track) { return track.acceleration; });
    vectors({"x_pred", "y_pred"}, [](const TrackEstimate& track) { return track.prior_position; });
    vectors({"rx", "ry"}, [](const TrackEstimate& track) {
      constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
      return track.residual.value_or(Eigen::Vector2d(kNone, kNone));
    });
    vectors({"sigma_x", "sigma_y"}, [](const TrackEstimate& track) { return track.sigma; });
    if (now.weighs_existence) {
      numbers("existence",
              [](const TrackEstimate& track) { return track.existence.value_or(1.0); });
    }
    return columns;
  }

 private:
  static SensorTraits traits(const OfflineConfig& config, std::optional<double> period) {
    const double chosen = config.period > 0.0 ? config.period : period.value_or(0.0);
    if (!(chosen > 0.0)) {
      throw std::invalid_argument("the time between scans is needed: give period");
    }
    return traits_of(config, chosen);
  }

  std::vector<Detection> detections(const Array& positions, const Array& covariances,
                                    const std::vector<std::string>& labels) const {
    const py::ssize_t count = positions.ndim() == 2 ? positions.shape(0) : -1;
    const bool has_covariances = covariances.size() > 0;
    if (count < 0 || positions.shape(1) != 2 ||
        (has_covariances && covariances.size() != 4 * count) ||
        (!labels.empty() && static_cast<py::ssize_t>(labels.size()) != count)) {
      throw std::invalid_argument(
          "a scan is an array (n, 2), with n covariances and labels, if any");
    }
    const Eigen::Matrix2d usual = noise_of(config_).cwiseAbs2().asDiagonal();
    std::vector<Detection> all(static_cast<std::size_t>(count));
    for (py::ssize_t i = 0; i < count; ++i) {
      Detection& detection = all[static_cast<std::size_t>(i)];
      detection.position = Eigen::Map<const Eigen::Vector2d>(positions.data() + 2 * i);
      detection.covariance =
          has_covariances
              ? Eigen::Matrix2d(Eigen::Map<const Eigen::Matrix2d>(covariances.data() + 4 * i))
              : usual;
      if (!labels.empty()) detection.label = labels[static_cast<std::size_t>(i)];
    }
    return all;
  }

  OfflineConfig config_;
  TrackerDesign design_;
  TrackerState state_;
};

}  // namespace

PYBIND11_MODULE(_tracker, m) {
  py::register_exception<SceneError>(m, "ConfigurationError", PyExc_ValueError);
  py::class_<LiveTracker>(m, "LiveTracker")
      .def(py::init<const std::string&, std::optional<double>>())
      .def("step", &LiveTracker::step)
      .def("tracks", &LiveTracker::tracks);
}

}  // namespace ghtrack
