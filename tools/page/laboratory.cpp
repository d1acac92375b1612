#include "tools/page/laboratory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/value_json.hpp"
#include "scenes/schema/value_reader.hpp"
#include "sensors/sensor.hpp"
#include "tools/metrics/following.hpp"
#include "tools/metrics/run_metrics.hpp"
#include "tools/page/flow_text.hpp"
#include "tools/run/run.hpp"
#include "tools/run/series.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack::page {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Reads a text in flow style into a described value; what it does not mention stays.
template <class T>
T read(std::string_view text) {
  static const std::vector<std::string> kOrigins = {""};
  T value{};
  std::vector<Diagnostic> found;
  schema::ValueReader(kOrigins, found).read(parse_flow(text), schema::type_of<T>(), &value);
  if (!found.empty()) throw SceneError(std::move(found));
  return value;
}

Contender contender_of(const TrackerConfig& config, const std::vector<SensorConfig>& sensors) {
  return {"", SceneTracker(config, traits_of(sensors))};
}

}  // namespace

/// Writes down what a run says.
class Laboratory::Notes final : public RunObserver {
 public:
  explicit Notes(Laboratory& lab) : lab_(lab) {
    for (const Contender& contender : lab.contenders_) {
      following_.emplace_back(lab.truth_->objects.size(),
                              FilterTheory{contender.tracker.design(), lab.scene_.sensors});
    }
    lab_.answers_.assign(lab.contenders_.size(), {});
    lab_.scans_.clear();
    lab_.detections_.clear();
  }

  void add_observation(const TruthSnapshot& /*truth*/, const Observation& observation) override {
    const Scan& scan = observation.scan;
    const auto index = static_cast<double>(lab_.scans_.size());
    lab_.scans_.push_back({scan.time, static_cast<double>(scan.sensor),
                           static_cast<double>(lab_.detections_.size()),
                           static_cast<double>(scan.detections.size())});
    for (std::size_t i = 0; i < scan.detections.size(); ++i) {
      const Detection& d = scan.detections[i];
      lab_.detections_.push_back({index, d.position.x(), d.position.y(), d.covariance(0, 0),
                                  d.covariance(0, 1), d.covariance(1, 1),
                                  static_cast<double>(lab_.word(d.label)),
                                  static_cast<double>(observation.origins[i])});
    }
  }

  void add_tracks(const StepRecord& record) override {
    if (!record.is_in_order()) return;
    Following& following = following_[record.contender];
    following.update(record);
    Answer& answer = lab_.answers_[record.contender];
    const auto index = static_cast<double>(answer.scans.size());
    answer.scans.push_back({record.tracks.time, static_cast<double>(record.tracks.sensor),
                            static_cast<double>(answer.tracks.size()),
                            static_cast<double>(record.tracks.tracks.size())});
    for (const TrackEstimate& track : record.tracks.tracks) {
      answer.tracks.push_back(row_of(track, index, following.object_of(track).value_or(-1)));
    }
  }

 private:
  TrackRow row_of(const TrackEstimate& track, double scan, ObjectId object) {
    const Eigen::Vector2d residual = track.residual.value_or(Eigen::Vector2d(kNone, kNone));
    const Eigen::Matrix2d& s = track.innovation_covariance;
    const Eigen::Matrix2d& p = track.covariance;
    return {.scan = scan,
            .id = static_cast<double>(track.id),
            .status = static_cast<double>(track.status),
            .filter = static_cast<double>(lab_.word(track.filter)),
            .label = static_cast<double>(lab_.word(track.label)),
            .x = track.position.x(),
            .y = track.position.y(),
            .vx = track.velocity.x(),
            .vy = track.velocity.y(),
            .ax = track.acceleration.x(),
            .ay = track.acceleration.y(),
            .x_pred = track.prior_position.x(),
            .y_pred = track.prior_position.y(),
            .rx = residual.x(),
            .ry = residual.y(),
            .sigma_x = track.sigma.x(),
            .sigma_y = track.sigma.y(),
            .s_xx = s(0, 0),
            .s_xy = s(0, 1),
            .s_yy = s(1, 1),
            .p_xx = p(0, 0),
            .p_xy = p(0, 1),
            .p_yy = p(1, 1),
            .existence = track.existence.value_or(kNone),
            .nis = track.nis.value_or(kNone),
            .object = static_cast<double>(object)};
  }

  Laboratory& lab_;
  std::vector<Following> following_;  // by contender
};

Laboratory::Laboratory(std::string_view scene, std::span<const double> truth) {
  const auto recorded = read<RecordedScene>(scene);
  scene_.duration = recorded.duration;
  scene_.seed = recorded.seed;
  truth_ = std::make_shared<const TruthRecording>(
      TruthRecording{.objects = from_recorded(recorded.objects),
                     .snapshots = from_numbers(truth),
                     .displacements = {},
                     .events = {}});
}

std::size_t Laboratory::word(std::string_view text) {
  const auto known = std::find(words_.begin(), words_.end(), text);
  const auto index = static_cast<std::size_t>(known - words_.begin());
  if (index == words_.size()) words_.emplace_back(text);
  return index;
}

void Laboratory::run(std::string_view setting) {
  const auto wanted = read<Setting>(setting);
  std::vector<Contender> contenders = {contender_of(wanted.tracker, wanted.sensors)};
  if (wanted.other) contenders.push_back(contender_of(*wanted.other, wanted.sensors));
  scene_.sensors = wanted.sensors;
  scene_.tracker = wanted.tracker;
  contenders_ = std::move(contenders);
  ReplayedTruth truth(truth_);
  Notes notes(*this);
  ghtrack::run(scene_, truth, contenders_, {&notes});
}

std::string Laboratory::metrics(std::size_t contender) const {
  ReplayedTruth truth(truth_);
  RunMetrics metrics(truth_->objects, scoring_for(traits_of(scene_.sensors)), 0,
                     FilterTheory{contenders_.at(contender).tracker.design(), scene_.sensors});
  const std::vector<RunCounts> counts =
      ghtrack::run(scene_, truth, {&contenders_.at(contender), 1}, {&metrics});
  RunReport report = metrics.report();
  report.counts = counts.front();
  return to_json(report).dump(2) + "\n";
}

std::string Laboratory::filter_json(std::string_view filter) {
  const auto config = read<FilterConfig>(filter);
  return schema::to_json(schema::type_of<FilterConfig>(), &config).dump();
}

std::string Laboratory::theory(std::string_view filter) const {
  const RunMetricsOptions scoring = scoring_for(traits_of(scene_.sensors));
  const auto config = read<FilterConfig>(filter);
  const Filter made = make_filter(config, scoring.sigma, scoring.period);
  const bool is_bank = std::visit(
      [](const auto& chosen) {
        return requires { bank_of(chosen); };
      },
      config);
  nlohmann::json json = {{"name", name(made)}, {"settles", !is_bank}};
  if (is_bank) return json.dump();
  const Gains gains = steady_gains(made).value();
  json.update({{"gains", gains_text(made)},
               {"g", gains.g},
               {"h", gains.h},
               {"k", gains.k},
               {"order", gains.order},
               {"sigma", scoring.sigma},
               {"dt", scoring.period},
               {"stable", is_stable(gains)}});
  if (!is_stable(gains)) return json.dump();
  const VarianceReduction vrf = variance_reduction(gains, scoring.period);
  const Lag lag = steady_lag(gains, scoring.period, 1.0);
  json["damping"] = to_string(damping(gains));
  json["damping_ratio"] = damping_ratio(gains);
  json["settling_updates"] = settling_updates(gains);
  json["vrf"] = {{"x", vrf.x}, {"prediction", vrf.prediction}};
  json["lag"] = {{"x", lag.x}, {"prediction", lag.prediction}};
  return json.dump();
}

std::string run_series(std::string_view scene) {
  const auto series = read<SeriesScene>(scene);
  const SeriesResult result = ghtrack::run(series);
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
  };
  nlohmann::json json = {{"measurement_rmse", number(result.measurement_rmse)},
                         {"ring", number(ring_of(series))},
                         {"is_of_readings", is_of_readings(series)}};
  for (const SeriesTrack& track : result.tracks) {
    nlohmann::json one = {{"filter", track.filter},
                          {"gains", track.gains},
                          {"rmse", number(track.rmse)},
                          {"mai", track.mai}};
    for (const SeriesRow& row : track.rows) {
      one["t"].push_back(row.t);
      one["z"].push_back(row.z);
      one["truth"].push_back(number(row.truth));
      one["x_pred"].push_back(row.x_pred);
      one["residual"].push_back(number(row.residual));
      one["x"].push_back(row.x);
      one["dx"].push_back(row.dx);
    }
    json["tracks"].push_back(std::move(one));
  }
  return json.dump();
}

}  // namespace ghtrack::page
