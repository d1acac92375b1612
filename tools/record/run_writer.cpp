#include "tools/record/run_writer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace ghtrack {
namespace {

/// What a value of an enum is called in scenes and files.
template <class Enum>
std::string_view name_of(Enum value) {
  for (const auto& [name, one] : enum_names(Enum{})) {
    if (one == value) return name;
  }
  return {};
}

}  // namespace

void write_events(const std::filesystem::path& path, const std::vector<WorldEvent>& events,
                  const std::vector<ObjectInfo>& objects) {
  const auto name = [&](ObjectId id) -> const std::string& {
    return objects.at(static_cast<std::size_t>(id)).name;
  };
  AtomicFile file(path);
  file.write("t,event,truth_id,name,other_id,other,x,y,impulse_x,impulse_y\n");
  CsvRow row;
  for (const WorldEvent& event : events) {
    row << event.time << name_of(event.kind) << event.object << name(event.object);
    if (event.other >= 0) {
      row << event.other << name(event.other);
    } else {
      row << std::string_view() << event.surface;
    }
    row << event.position.x() << event.position.y() << event.impulse.x() << event.impulse.y();
    row.end();
    file.write(row.text());
    row.clear();
  }
  file.commit();
}

TrackColumns innovation_columns() {
  return {.names = {"s_x", "s_y"}, .append = [](CsvRow& row, const TrackEstimate& track) {
            for (const int axis : {0, 1}) {
              row << std::sqrt(track.innovation_covariance(axis, axis));
            }
          }};
}

TrackWriter::TrackWriter(std::filesystem::path path, TrackColumns more)
    : file_(std::move(path)), more_(std::move(more)) {}

void TrackWriter::write_header(bool with_existence) {
  if (has_header_) return;
  has_header_ = true;
  file_.write("t,track_id,status,filter,x,y,vx,vy,ax,ay,x_pred,y_pred,rx,ry,sigma_x,sigma_y");
  if (with_existence) file_.write(",existence");
  for (const std::string& name : more_.names) file_.write("," + name);
  file_.write("\n");
}

void TrackWriter::add(const TrackSnapshot& snapshot) {
  write_header(snapshot.weighs_existence);
  if (snapshot.time != time_) file_.write(pending_.text());
  pending_.clear();
  time_ = snapshot.time;
  for (const TrackEstimate& track : snapshot.tracks) {
    pending_ << snapshot.time << track.id << to_string(track.status) << track.filter
             << track.position.x() << track.position.y() << track.velocity.x() << track.velocity.y()
             << track.acceleration.x() << track.acceleration.y() << track.prior_position.x()
             << track.prior_position.y();
    std::optional<double> rx, ry;
    if (track.residual) {
      rx = track.residual->x();
      ry = track.residual->y();
    }
    pending_ << rx << ry << track.sigma.x() << track.sigma.y();
    if (snapshot.weighs_existence) pending_ << track.existence;
    if (more_.append) more_.append(pending_, track);
    pending_.end();
  }
}

void TrackWriter::commit() {
  write_header(false);
  file_.write(pending_.text());
  pending_.clear();
  file_.commit();
}

void TrackWriter::keep_partial() {
  write_header(false);
  file_.write(pending_.text());
  pending_.clear();
  file_.keep_partial();
}

RunWriter::RunWriter(const std::filesystem::path& folder, std::vector<ObjectInfo> objects,
                     std::vector<std::string> sensors, TrackColumns more_of_tracks,
                     std::vector<TruthColumn> more_of_truth)
    : objects_(std::move(objects)),
      sensors_(std::move(sensors)),
      truth_columns_(std::move(more_of_truth)),
      truth_(folder / "truth.csv"),
      detections_(folder / "detections.csv"),
      origins_(folder / "origins.csv"),
      tracks_(folder / "tracks.csv", std::move(more_of_tracks)) {
  truth_.write("t,truth_id,name,kind,x,y,vx,vy,ax,ay");
  for (const TruthColumn column : truth_columns_) {
    truth_.write(column == TruthColumn::kWind ? ",wind_x,wind_y"
                                              : "," + std::string(name_of(column)));
  }
  truth_.write("\n");
  detections_.write("t,sensor,class,x,y\n");
  origins_.write("t,sensor,x,y,truth_id\n");
}

void RunWriter::add_tracks(const StepRecord& record) {
  if (record.contender == 0 && record.is_in_order()) tracks_.add(record.tracks);
}

void RunWriter::commit() {
  truth_.commit();
  detections_.commit();
  origins_.commit();
  tracks_.commit();
}

void RunWriter::keep_partial() {
  truth_.keep_partial();
  detections_.keep_partial();
  origins_.keep_partial();
  tracks_.keep_partial();
}

void RunWriter::write_truth(const TruthSnapshot& truth) {
  if (truth.time == truth_time_) return;  // several sensors saw the same instant
  truth_time_ = truth.time;
  rows_.clear();
  for (const TruthState& state : truth.objects) {
    const ObjectInfo& object = objects_.at(static_cast<std::size_t>(state.id));
    rows_ << truth.time << state.id << object.name << object.regime << state.position.x()
          << state.position.y() << state.velocity.x() << state.velocity.y()
          << state.acceleration.x() << state.acceleration.y();
    // Of an object with several parts the first speaks for it; they come in the order of the ids.
    const auto part =
        std::lower_bound(truth.bodies.begin(), truth.bodies.end(), state.id,
                         [](const BodyPose& body, ObjectId id) { return body.id < id; });
    for (const TruthColumn column : truth_columns_) {
      switch (column) {
        case TruthColumn::kHeading:
          rows_ << part->angle;
          break;
        case TruthColumn::kSpin:
          rows_ << part->spin;
          break;
        case TruthColumn::kWind:
          rows_ << state.wind.x() << state.wind.y();
          break;
        case TruthColumn::kCouplerForce:
          rows_ << state.coupler_force;
          break;
      }
    }
    rows_.end();
  }
  truth_.write(rows_.text());
}

void RunWriter::add_observation(const TruthSnapshot& truth, const Observation& observation) {
  write_truth(truth);
  const Scan& scan = observation.scan;
  const auto index = static_cast<std::size_t>(scan.sensor);
  const std::string sensor =
      index < sensors_.size() ? sensors_[index] : std::to_string(scan.sensor);
  rows_.clear();
  origin_rows_.clear();
  for (std::size_t i = 0; i < scan.detections.size(); ++i) {
    const Detection& detection = scan.detections[i];
    rows_ << scan.time << sensor << detection.label;
    const std::size_t before = rows_.text().size() + 1;
    rows_ << detection.position.x() << detection.position.y();
    origin_rows_ << scan.time << sensor;
    origin_rows_.copy_cells(std::string_view(rows_.text()).substr(before));
    origin_rows_ << observation.origins.at(i);
    rows_.end();
    origin_rows_.end();
  }
  detections_.write(rows_.text());
  origins_.write(origin_rows_.text());
}

}  // namespace ghtrack
