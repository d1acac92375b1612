// `ghtrack track`: the tracker alone, on somebody else's detections.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "scenes/schema/configuration.hpp"
#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/reference.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/pipeline/box_tracking.hpp"
#include "tools/pipeline/offline.hpp"
#include "tools/record/csv_reader.hpp"
#include "tools/record/mot_file.hpp"
#include "tools/record/mot_folder.hpp"
#include "tools/record/run_writer.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

/// Wall time of each stage over all files [s].
class StageTimes {
 public:
  enum Stage { kRead, kTrack, kWrite };

  /// Runs one stage.
  template <class Work>
  auto of(Stage stage, Work work) {
    const Timer timer(seconds_[stage]);
    return work();
  }
  void count_scans(std::size_t scans) { scans_ += scans; }

  /// Says what the tracker's own stages took of a stage that was timed as tracking, although it
  /// wrote its results as well.
  void split_tracking(const StepTimes& steps) {
    steps_ = steps;
    seconds_[kWrite] += seconds_[kTrack] - steps.total();
    seconds_[kTrack] = steps.total();
  }

  std::string text() const {
    std::string stages;
    if (steps_) {
      stages = fmt::format(" (predict {:.6f}, associate {:.6f}, update {:.6f}, begin {:.6f})",
                           steps_->predict, steps_->associate, steps_->update, steps_->begin);
    }
    return fmt::format(
        "read {:.6f} s, track {:.6f} s{}, write {:.6f} s; {} scans, {:.0f} per second",
        seconds_[kRead], seconds_[kTrack], stages, seconds_[kWrite], scans_,
        static_cast<double>(scans_) / std::max(seconds_[kTrack], 1e-9));
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Timer {
    explicit Timer(double& seconds) : sum(seconds) {}
    ~Timer() { sum += std::chrono::duration<double>(Clock::now() - start).count(); }
    double& sum;
    Clock::time_point start = Clock::now();
  };

  double seconds_[3] = {};
  std::optional<StepTimes> steps_;
  std::size_t scans_ = 0;
};

/// A folder as the output gets a file of that name.
fs::path output_file(const std::string& output, const std::string& name) {
  std::error_code ignored;
  if (output.empty()) return "-";
  return fs::is_directory(output, ignored) ? fs::path(output) / name : fs::path(output);
}

void report_refusals(const auto& state, const Manners& manners) {
  if (manners.quiet || state.scans_refused + state.detections_refused == 0) return;
  tell("ghtrack: warning: refused {} scans out of order and {} unusable detections",
       state.scans_refused, state.detections_refused);
}

void track_csv(const TrackOptions& options, const OfflineConfig& config, StageTimes& times,
               const Manners& manners) {
  const DetectionTable table =
      times.of(StageTimes::kRead, [&] { return read_detections_csv(options.detections.front()); });
  times.count_scans(table.scans.size());
  TrackWriter writer(output_file(options.output, "tracks.csv"));
  StepTimes steps;
  const TrackerState state = times.of(StageTimes::kTrack, [&] {
    const auto add = [&](const TrackSnapshot& snapshot) {
      stop_if_interrupted();
      writer.add(snapshot);
    };
    return track_offline(config, table.scans, add, &steps);
  });
  times.split_tracking(steps);
  times.of(StageTimes::kWrite, [&] { writer.commit(); });
  report_refusals(state, manners);
}

std::size_t images_in(const std::vector<MotRow>& rows) {
  std::size_t images = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    images += i == 0 || rows[i].frame != rows[i - 1].frame;
  }
  return images;
}

void track_sequences(const TrackOptions& options, const OfflineConfig& config, StageTimes& times,
                     const Manners& manners) {
  std::optional<EvaluationFolder> evaluation;
  if (!options.evaluation_folder.empty()) {
    evaluation.emplace(EvaluationLayout{.root = options.evaluation_folder,
                                        .benchmark = options.benchmark,
                                        .split = options.split,
                                        .tracker = options.tracker_name});
  }
  for (const std::string& path : options.detections) {
    const MotSequence sequence = open_mot_sequence(path);
    const std::vector<MotRow> detections = times.of(StageTimes::kRead, [&] {
      std::optional<std::int32_t> last_frame;
      if (sequence.info && sequence.info->length > 0) last_frame = sequence.info->length;
      return read_mot_file(sequence.detections, MotKind::kDetections, last_frame);
    });
    times.count_scans(images_in(detections));
    const BoxTracks tracks = times.of(StageTimes::kTrack, [&] {
      stop_if_interrupted();
      return track_boxes(config.boxes, config.box_output, detections);
    });
    if (!manners.quiet) {
      tell("ghtrack: {}: {}", sequence.name, summary(config.boxes, detections, tracks));
    }
    report_refusals(tracks.state, manners);
    times.of(StageTimes::kWrite, [&] {
      std::string rows;
      for (const MotRow& row : tracks.rows) append_mot_row(rows, row);
      const std::int32_t last = detections.empty() ? 1 : detections.back().frame;
      if (evaluation) evaluation->add(sequence, rows, last);
      if (!evaluation || !options.output.empty()) {
        const bool several = options.detections.size() > 1;
        write_file(output_file(options.output, several ? sequence.name + ".txt" : "tracks.txt"),
                   rows);
      }
    });
  }
  if (evaluation) evaluation->finish();
}

/// Whether the input is boxes of MOTChallenge rather than points of a CSV file.
bool is_mot(const TrackOptions& options) {
  if (options.format != "auto") return options.format == "mot";
  std::error_code ignored;
  const std::string& first = options.detections.front();
  return fs::is_directory(first, ignored) || looks_like_mot_file(first);
}

void check(const TrackOptions& options, bool boxes) {
  std::error_code ignored;
  for (const std::string* name : {&options.benchmark, &options.split, &options.tracker_name}) {
    if (name->empty() || name->find('/') != std::string::npos || name->front() == '.') {
      throw UsageError(fmt::format("track: '{}' cannot be the name of a folder", *name));
    }
  }
  if (options.detections.size() == 1) return;
  if (!boxes) throw UsageError("track: several files must be MOTChallenge sequences");
  const bool wants_files = options.evaluation_folder.empty() || !options.output.empty();
  if (wants_files && !fs::is_directory(options.output, ignored)) {
    throw UsageError(
        "track: several sequences need --evaluation-folder, or -o with a folder that exists");
  }
  std::set<std::string> names;
  for (const std::string& path : options.detections) {
    const std::string name = open_mot_sequence(path).name;
    if (names.insert(name).second) continue;
    throw UsageError(fmt::format("track: two sequences are called '{}'", name));
  }
}

}  // namespace

int track(const TrackOptions& options, const Manners& manners) {
  const std::string& format = options.format;
  if (format != "auto" && format != "csv" && format != "mot") {
    throw UsageError(fmt::format("track: --format is '{}'; allowed are auto, csv and mot", format));
  }
  const bool boxes = is_mot(options);
  check(options, boxes);
  OfflineConfig config;
  if (!options.config.empty()) {
    config = schema::read_configuration_file<OfflineConfig>(options.config);
  }
  StageTimes times;
  if (boxes) {
    track_sequences(options, config, times, manners);
  } else {
    track_csv(options, config, times, manners);
  }
  if (options.timings) tell("ghtrack: {}", times.text());
  return 0;
}

int track_reference() {
  print(R"(# Files for `ghtrack track --config`

How somebody else's detections are tracked. All keys are optional. `boxes` and `box_output` are for
boxes of MOTChallenge, whose lengths are multiples of a box's scale, the root of its area, and whose
times count images; all others are for points. What has no default is learned from the data.

)" + schema::reference_tables(schema::type_of<OfflineConfig>()));
  return 0;
}

}  // namespace ghtrack::cli
