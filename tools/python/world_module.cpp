// `ghtrack._world`: runs a scene in this process and gives what it wrote as columns of numbers.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "tools/data/words.hpp"
#include "tools/experiment/hindsight.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/run/contender.hpp"
#include "tools/run/run.hpp"

namespace py = pybind11;

namespace ghtrack {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr int kScansBetweenSignals = 64;

/// The memory of a vector as an array, without a copy.
template <class Number>
py::array_t<Number> as_array(std::vector<Number>&& values) {
  auto owner = std::make_unique<std::vector<Number>>(std::move(values));
  const auto size = static_cast<py::ssize_t>(owner->size());
  const Number* const data = owner->data();
  const py::capsule keeper(owner.release(),
                           [](void* all) { delete static_cast<std::vector<Number>*>(all); });
  return py::array_t<Number>(size, data, keeper);
}

/// A column of words: the index of each row's, and all of them.
struct WordColumn {
  Words words;
  std::vector<std::int32_t> rows;

  void add(std::string_view word) { rows.push_back(words.number_of(word)); }
  py::tuple take() { return py::make_tuple(as_array(std::move(rows)), words.words()); }
};

/// Columns by name.
class Columns {
 public:
  explicit Columns(std::vector<const char*> names) : names_(std::move(names)) {
    columns_.resize(names_.size());
  }

  void add(std::initializer_list<double> row) {
    std::size_t i = 0;
    for (const double value : row) columns_[i++].push_back(value);
  }
  std::size_t rows() const { return columns_.front().size(); }
  void cut(std::size_t rows) {
    for (std::vector<double>& column : columns_) column.resize(rows);
  }

  void give(py::dict& table) {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      table[names_[i]] = as_array(std::move(columns_[i]));
    }
  }

 private:
  std::vector<const char*> names_;
  std::vector<std::vector<double>> columns_;
};

/// Gathers the rows of truth.csv, detections.csv, origins.csv and tracks.csv.
class RunColumns final : public RunObserver {
 public:
  RunColumns(const WorldScene& scene, std::vector<ObjectInfo> objects)
      : scene_(scene), objects_(std::move(objects)) {}

  void add_observation(const TruthSnapshot& truth, const Observation& observation) override {
    if (++scans_ % kScansBetweenSignals == 0) stop_if_interrupted();
    if (truth.time != truth_time_) {  // several sensors may have seen one instant
      truth_time_ = truth.time;
      for (const TruthState& state : truth.objects) {
        const ObjectInfo& object = objects_.at(static_cast<std::size_t>(state.id));
        names_.add(object.name);
        kinds_.add(object.regime);
        truth_.add({truth.time, static_cast<double>(state.id), state.position.x(),
                    state.position.y(), state.velocity.x(), state.velocity.y(),
                    state.acceleration.x(), state.acceleration.y()});
      }
    }
    const Scan& scan = observation.scan;
    const std::string& sensor = scene_.sensors.at(static_cast<std::size_t>(scan.sensor)).name;
    for (std::size_t i = 0; i < scan.detections.size(); ++i) {
      const Detection& detection = scan.detections[i];
      sensors_.add(sensor);
      classes_.add(detection.label);
      detections_.add({scan.time, detection.position.x(), detection.position.y(),
                       static_cast<double>(observation.origins.at(i))});
    }
  }

  void add_tracks(const StepRecord& record) override {
    if (record.contender != 0 || !record.is_in_order()) return;
    const TrackSnapshot& now = record.tracks;
    weighs_existence_ = now.weighs_existence;
    if (now.time == track_time_) {  // of several scans at one instant the last one counts
      tracks_.cut(first_of_instant_);
      statuses_.rows.resize(first_of_instant_);
      filters_.rows.resize(first_of_instant_);
    }
    track_time_ = now.time;
    first_of_instant_ = tracks_.rows();
    for (const TrackEstimate& track : now.tracks) {
      const Eigen::Vector2d residual = track.residual.value_or(Eigen::Vector2d(kNothing, kNothing));
      statuses_.add(to_string(track.status));
      filters_.add(track.filter);
      tracks_.add({now.time, static_cast<double>(track.id), track.position.x(), track.position.y(),
                   track.velocity.x(), track.velocity.y(), track.acceleration.x(),
                   track.acceleration.y(), track.prior_position.x(), track.prior_position.y(),
                   residual.x(), residual.y(), track.sigma.x(), track.sigma.y(),
                   track.existence.value_or(kNothing)});
    }
  }

  /// All tables; nothing is left here.
  py::dict take() {
    py::dict truth, detections, tracks, all;
    truth_.give(truth);
    truth["name"] = names_.take();
    truth["kind"] = kinds_.take();
    detections_.give(detections);
    detections["sensor"] = sensors_.take();
    detections["class"] = classes_.take();
    tracks_.give(tracks);
    tracks["status"] = statuses_.take();
    tracks["filter"] = filters_.take();
    if (!weighs_existence_) tracks.attr("pop")("existence");
    all["truth"] = truth;
    all["detections"] = detections;
    all["tracks"] = tracks;
    return all;
  }

 private:
  static void stop_if_interrupted() {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

  const WorldScene& scene_;
  std::vector<ObjectInfo> objects_;
  int scans_ = 0;
  double truth_time_ = kNothing, track_time_ = kNothing;  // [s]
  std::size_t first_of_instant_ = 0;                      // row of tracks
  bool weighs_existence_ = false;
  Columns truth_{{"t", "truth_id", "x", "y", "vx", "vy", "ax", "ay"}};
  Columns detections_{{"t", "x", "y", "truth_id"}};
  Columns tracks_{{"t", "track_id", "x", "y", "vx", "vy", "ax", "ay", "x_pred", "y_pred", "rx",
                   "ry", "sigma_x", "sigma_y", "existence"}};
  WordColumn names_, kinds_, sensors_, classes_, statuses_, filters_;
};

/// @param name       of the scene's file, for messages
/// @param overrides  KEY=VALUE each
/// @return tables, metrics as JSON and the table that the program prints; None for a series
py::object run_scene(const std::string& text, const std::string& name,
                     const std::vector<std::string>& overrides) {
  std::optional<RunColumns> columns;
  RunReport report;
  {
    const py::gil_scoped_release release;
    const Scene any_scene = read_scene_text(text, name, overrides);
    const auto* const scene = std::get_if<WorldScene>(&any_scene);
    if (scene != nullptr) {
      SimulatedTruth truth([scene] { return make_world(*scene); });
      columns.emplace(*scene, truth.objects());
      const std::vector<Contender> contenders = {own_tracker(*scene)};
      RunMetrics metrics(truth.objects(), scoring_for(traits_of(scene->sensors)), 0,
                         FilterTheory{contenders.front().tracker.design(), scene->sensors});
      const std::size_t objects = truth.objects().size();
      LabelledObjectRecorder labelled(objects, objects_for_hindsight(*scene, objects));
      const auto counts = run(*scene, truth, contenders, {&*columns, &metrics, &labelled});
      report = metrics.report();
      report.counts = counts.front();
      add_hindsight(report, std::move(labelled).objects(), *scene, [] {});
    }
  }
  if (!columns) return py::none();
  py::dict result = columns->take();
  result["metrics"] = to_json(report).dump();
  result["summary"] = to_table(report);
  return result;
}

}  // namespace

PYBIND11_MODULE(_world, m) {
  py::register_exception<SceneError>(m, "SceneError", PyExc_ValueError);
  m.def("run", &run_scene);
}

}  // namespace ghtrack
