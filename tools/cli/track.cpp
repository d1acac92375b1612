// `ghtrack track`: the tracker alone, on somebody else's detections.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "scenes/schema/configuration.hpp"
#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/reference.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/data_source.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/smoothed_tracks.hpp"
#include "tools/cli/track_film.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/data/formats.hpp"
#include "tools/data/scan_reader.hpp"
#include "tools/plot/figure_file.hpp"
#include "tools/plot/track_figure.hpp"
#include "tools/record/atomic_file.hpp"
#include "tools/record/kitti_file.hpp"
#include "tools/record/mot_file.hpp"
#include "tools/record/mot_folder.hpp"
#include "tools/record/run_writer.hpp"
#include "tools/run/box_tracking.hpp"
#include "tools/run/learning.hpp"
#include "tools/run/offline.hpp"
#include "tools/run/online.hpp"
#include "tools/run/shared_times.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

/// Wall time of each stage over all files [s].
class StageTimes {
 public:
  enum Stage { kOther, kRead, kLearn, kTrack, kWrite };

  /// Runs one stage, whose time does not count for the stage that it is part of.
  template <class Work>
  auto of(Stage stage, Work work) {
    const Timer timer(*this, stage);
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
        "read {:.6f} s, learn {:.6f} s, track {:.6f} s{}, write {:.6f} s; {} scans, {:.0f} per "
        "second",
        seconds_[kRead], seconds_[kLearn], seconds_[kTrack], stages, seconds_[kWrite], scans_,
        static_cast<double>(scans_) / std::max(seconds_[kTrack], 1e-9));
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Makes a stage the present one while it lives.
  struct Timer {
    Timer(StageTimes& of, Stage stage) : times(of), before(times.change(stage)) {}
    ~Timer() { times.change(before); }
    StageTimes& times;
    Stage before;
  };

  Stage change(Stage stage) {
    const auto now = Clock::now();
    seconds_[now_] += std::chrono::duration<double>(now - since_).count();
    since_ = now;
    return std::exchange(now_, stage);
  }

  double seconds_[5] = {};
  Stage now_ = kOther;
  Clock::time_point since_ = Clock::now();
  std::optional<StepTimes> steps_;
  std::size_t scans_ = 0;
};

/// A folder as the output gets a file of that name.
fs::path output_file(const std::string& output, const std::string& name) {
  std::error_code ignored;
  if (output.empty()) return "-";
  return fs::is_directory(output, ignored) ? fs::path(output) / name : fs::path(output);
}

/// Watches how well the tracker's assumptions fit what it tracks.
class FitWatch {
 public:
  void add(const TrackSnapshot& now) {
    for (const TrackEstimate& track : now.tracks) {
      ids_.insert(track.id);
      if (track.status == TrackStatus::kTentative) continue;
      confirmed_.insert(track.id);
      if (!track.nis) continue;
      nis_ += *track.nis;
      ++updates_;
    }
  }

  /// Says what does not fit, why, and what to set.
  /// @param learned  whether noise and motion are what the data themselves say
  void report(const OfflineConfig& config, bool learned) const {
    if (confirmed_.empty()) {
      tell(
          "ghtrack: warning: nothing was confirmed of {} tracks that began: nothing seems to go on "
          "from scan to scan. If something does, say in a file for --config how: 'noise' and "
          "'period', for each filter 'initial_speed', 'detection_probability' and 'clutter'; if "
          "a scan shows one object of many, 'scan: partial'",
          ids_.size());
      return;
    }
    constexpr int kFewest = 20;
    constexpr double kExpected = 2.0;  // two coordinates
    if (updates_ < kFewest) return;
    const double ratio = nis_ / updates_ / kExpected;
    if (ratio > kFar) {
      tell(
          "ghtrack: warning: a poor fit: squared residuals are {:.2g} times what the filters "
          "expect: 'noise'{} or the filters' process noise is too small",
          ratio, config.noise ? fmt::format(" ({:.3g})", *config.noise) : "");
    } else if (ratio < 1.0 / kFar && learned) {
      tell(
          "ghtrack: the paths are smoother than random motion: squared residuals are {:.2g} times "
          "what the filters expect, and errors are smaller than they are said to be",
          ratio);
    } else if (ratio < 1.0 / kFar) {
      tell(
          "ghtrack: warning: a poor fit: squared residuals are {:.2g} times what the filters "
          "expect: 'noise'{} or the filters' process noise is too great",
          ratio, config.noise ? fmt::format(" ({:.3g})", *config.noise) : "");
    }
  }

 private:
  static constexpr double kFar = 2.0;
  std::set<int> ids_, confirmed_;
  double nis_ = 0.0;
  int updates_ = 0;
};

void report_refusals(const auto& state, const Manners& manners) {
  if (manners.quiet || state.scans_refused + state.detections_refused == 0) return;
  tell("ghtrack: warning: refused {} scans out of order and {} unusable detections",
       state.scans_refused, state.detections_refused);
}

/// The origin of local metres in every row, and degrees if they were asked for.
TrackColumns geographic_columns(const std::optional<GeoPoint>& origin, bool degrees) {
  if (!origin) return {};
  TrackColumns columns{.names = {"origin_lat", "origin_lon"}, .append = {}};
  if (degrees) columns.names.insert(columns.names.end(), {"lat", "lon"});
  columns.append = [origin, degrees](CsvRow& row, const TrackEstimate& track) {
    row << origin->latitude << origin->longitude;
    if (!degrees) return;
    const GeoPoint point = to_degrees(*origin, track.position);
    row << point.latitude << point.longitude;
  };
  return columns;
}

TrackColumns joined(TrackColumns first, TrackColumns second) {
  first.names.insert(first.names.end(), second.names.begin(), second.names.end());
  return {.names = std::move(first.names),
          .append = [first = std::move(first.append), second = std::move(second.append)](
                        CsvRow& row, const TrackEstimate& track) {
            if (first) first(row, track);
            if (second) second(row, track);
          }};
}

/// Draws tracks over their detections, beside the file that has them.
void write_plots(const fs::path& tracks, const TrackOptions& options) {
  const plot::Figure figure =
      plot::figure_of({.tracks = tracks.string(),
                       .truth = {},
                       .detections = options.detections.front(),
                       .panels = {},
                       .cutoff = 0.0,
                       .title = fs::path(options.detections.front()).filename().string(),
                       .reading = read_options(options.data)});
  fs::path picture = tracks;
  plot::write_figure(picture.replace_extension(".svg"), figure, {});
}

/// Gathers whole tracks in degrees, without what is tentative.
class GeoTracks {
 public:
  explicit GeoTracks(const GeoPoint& origin) : origin_(origin) {}

  void add(const TrackSnapshot& now) {
    for (const TrackEstimate& track : now.tracks) {
      if (track.status == TrackStatus::kTentative) continue;
      GeoTrack& own = by_id_[track.id];
      own.id = track.id;
      const GeographicPoint point{now.time, to_degrees(origin_, track.position)};
      if (!own.points.empty() && own.points.back().time == now.time) own.points.pop_back();
      own.points.push_back(point);
    }
  }

  std::vector<GeoTrack> all() const {
    std::vector<GeoTrack> tracks;
    for (const auto& [id, track] : by_id_) tracks.push_back(track);
    return tracks;
  }

 private:
  GeoPoint origin_;
  std::map<int, GeoTrack> by_id_;
};

/// The tracker of the data, once all is learned.
TrackerDesign design_of(const OfflineConfig& config, const ScanSource& scans) {
  std::vector<SensorTraits> traits;
  for (const std::string& name : scans.sensors) {
    traits.push_back(traits_of(config.sensor(name), scans.period > 0.0 ? scans.period : 1.0));
  }
  return TrackerDesign(config.tracker, traits);
}

void track_csv(const TrackOptions& options, OfflineConfig config, StageTimes& times,
               const Manners& manners) {
  ScanReader reader = times.of(StageTimes::kRead, [&] {
    return ScanReader(options.detections.front(), read_options(options.data));
  });
  const DataSummary& summary = reader.summary();
  tell_what_was_read(summary, manners);
  const bool geographic = is_geographic_file(options.output);
  if ((options.degrees || geographic) && !summary.origin) {
    throw UsageError("track: --degrees, GPX and GeoJSON need data in degrees");
  }
  if (options.smooth && geographic) {
    throw UsageError("track: --smooth adds columns to CSV; GPX and GeoJSON have none");
  }
  ScanSource rows{.next =
                      [&](Scan& scan) {
                        stop_if_interrupted();
                        return reader.next(scan);
                      },
                  .period = summary.period};
  if (!summary.sensors.empty()) rows.sensors = summary.sensors;
  const std::optional<double> in_a_row = rows_of_one_object(first_of(rows));
  reader.rewind();
  if (in_a_row && !manners.quiet) {
    tell(
        "ghtrack: warning: rows with the same time go on as one object: their times seem to be "
        "cut, and are spread evenly until the next one; give them with all decimals");
  }
  ScanSource scans = in_a_row ? spread(rows, *in_a_row) : rows;
  const auto tell_what_was_learned = [&](const LearnedConfig& learned) {
    if (manners.quiet) return;
    for (const std::string& line : describe(learned)) tell("ghtrack: {}", line);
  };
  const bool learns = leaves_open(config, scans.sensors, summary.has_sigma);
  if (learns && !options.online) {
    const LearnedConfig learned =
        times.of(StageTimes::kLearn, [&] { return learn_offline(config, scans); });
    reader.rewind();
    if (in_a_row) scans = spread(rows, *in_a_row);
    config = learned.config;
    tell_what_was_learned(learned);
  }
  TrackFilm film;
  const bool filmed = !options.film.output.empty();
  if (filmed) {
    scans.next = [next = scans.next, &film](Scan& scan) {
      if (!next(scan)) return false;
      film.add(scan);
      return true;
    };
  }
  StepTimes steps;
  FitWatch watch;
  TrackerState state;
  const auto track_all = [&](const auto& on_scan) {
    times.of(StageTimes::kTrack, [&] {
      const auto on_tracked = [&](const TrackSnapshot& now, const Scan& scan) {
        times.count_scans(1);
        watch.add(now);
        on_scan(now, scan);
      };
      if (learns && options.online) {
        std::optional<LearnedConfig> last;
        state = track_online(
            config, scans, on_tracked, [&](const LearnedConfig& now) { last = now; }, &steps);
        if (last) {
          tell_what_was_learned(*last);
          config = last->config;
        }
      } else {
        state = track_offline(config, scans, on_tracked, &steps);
      }
    });
    times.split_tracking(steps);
  };
  if (geographic) {
    GeoTracks tracks(*summary.origin);
    track_all([&](const TrackSnapshot& now, const Scan&) {
      tracks.add(now);
      if (filmed) film.add(now);
    });
    times.of(StageTimes::kWrite,
             [&] { write_file(options.output, as_geographic_file(options.output, tracks.all())); });
  } else {
    TrackColumns columns = geographic_columns(summary.origin, options.degrees);
    if (options.plots) columns = joined(std::move(columns), innovation_columns());
    const fs::path file = output_file(options.output, "tracks.csv");
    if (options.smooth) {
      TrackHistory history(design_of(config, scans));
      track_all([&](const TrackSnapshot& now, const Scan& scan) { history.add(now, scan); });
      times.of(StageTimes::kWrite, [&] {
        const std::vector<SmoothedSnapshot> smoothed = history.smoothed();
        write_smoothed_tracks(file, smoothed, std::move(columns));
        for (const SmoothedSnapshot& now : smoothed) {
          if (filmed) film.add(now);
        }
      });
    } else {
      TrackWriter writer(file, std::move(columns));
      track_all([&](const TrackSnapshot& now, const Scan&) {
        writer.add(now);
        if (filmed) film.add(now);
      });
      times.of(StageTimes::kWrite, [&] { writer.commit(); });
    }
  }
  if (!options.save_config.empty()) {
    write_file(options.save_config, schema::write_configuration(config));
  }
  if (!manners.quiet) watch.report(config, learns);
  report_refusals(state, manners);
  if (options.plots) write_plots(output_file(options.output, "tracks.csv"), options);
  if (!filmed) return;
  FilmOptions wanted = options.film;
  if (options.data.frame_rate) wanted.frame_rate = options.data.frame_rate;
  wanted.counts_frames = options.data.frame_rate.has_value();
  film.write(wanted, summary.period, summary.origin, manners);
}

/// What is filmed of a sequence, all of it in memory.
struct SequenceRows {
  std::vector<MotRow> detections, tracks;  // by frame
};

/// Films the boxes of a sequence over its images.
void film_sequence(const TrackOptions& options, const MotSequence& sequence,
                   const SequenceRows& rows, const Manners& manners) {
  constexpr double kUsualRate = 30.0;  // [Hz]
  FilmOptions wanted = options.film;
  const fs::path images = sequence.detections.parent_path().parent_path() / "img1";
  std::error_code ignored;
  if (wanted.background.empty() && fs::is_directory(images, ignored)) {
    wanted.background = images.string();
  }
  wanted.frame_rate = options.data.frame_rate ? *options.data.frame_rate
                      : sequence.info         ? sequence.info->frame_rate
                                              : kUsualRate;
  if (sequence.info && sequence.info->width > 0 && sequence.info->height > 0) {
    wanted.width = sequence.info->width;
    wanted.height = sequence.info->height;
  }
  TrackFilm::of_boxes(rows.tracks, rows.detections, *wanted.frame_rate)
      .write(wanted, 1.0 / *wanted.frame_rate, std::nullopt, manners);
}

/// What the boxes of each track show: what most of the detections in their places do.
class TypeVotes {
 public:
  /// @param detections  read as far as the frames of the tracks before
  explicit TypeVotes(KittiReader& detections) : detections_(detections) {}

  /// @param tracks  of the next frame
  void add(std::span<const MotRow> tracks) {
    const std::int32_t frame = tracks.front().frame;
    while (seen_.empty() || seen_.front().box.frame < frame) {
      seen_ = detections_.next();
      if (seen_.empty()) return;
    }
    if (seen_.front().box.frame != frame) return;
    for (const MotRow& track : tracks) {
      const auto distance = [&](const KittiRow& row) {
        return std::hypot(row.box.left + 0.5 * row.box.width - track.left - 0.5 * track.width,
                          row.box.top + 0.5 * row.box.height - track.top - 0.5 * track.height);
      };
      const KittiRow* nearest = nullptr;
      for (const KittiRow& row : seen_) {
        if (row.type == kNotLabelled) continue;
        if (nearest == nullptr || distance(row) < distance(*nearest)) nearest = &row;
      }
      if (nearest != nullptr && distance(*nearest) < 0.5 * track.width) {
        ++votes_[track.id][nearest->type];
      }
    }
  }

  std::map<std::int64_t, std::string> types() const {
    std::map<std::int64_t, std::string> types;
    for (const auto& [id, counts] : votes_) {
      types[id] = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
                    return a.second < b.second;
                  })->first;
    }
    return types;
  }

 private:
  KittiReader& detections_;
  std::span<const KittiRow> seen_;  // in the latest frame
  std::map<std::int64_t, std::map<std::string, int>> votes_;
};

/// Tracks one sequence after the other, each frame by frame.
class SequenceTracking {
 public:
  SequenceTracking(const TrackOptions& options, const OfflineConfig& config, StageTimes& times,
                   const Manners& manners)
      : options_(options), config_(config), times_(times), manners_(manners) {
    if (options.evaluation_folder.empty()) return;
    evaluation_.emplace(EvaluationLayout{.root = options.evaluation_folder,
                                         .benchmark = options.benchmark,
                                         .split = options.split,
                                         .tracker = options.tracker_name});
  }

  void track(const MotSequence& sequence) {
    std::optional<std::int32_t> last_frame;
    if (sequence.info && sequence.info->length > 0) last_frame = sequence.info->length;
    MotReader detections = times_.of(StageTimes::kRead, [&] {
      return MotReader(sequence.detections, MotKind::kDetections, last_frame, stop_if_interrupted);
    });
    tell_if_sorted(sequence.detections.string(), detections.in_order(), manners_);
    if (detections.counts_from_zero() && !manners_.quiet) {
      tell("ghtrack: {}: counts its frames from 0; here they count from 1",
           sequence.detections.string());
    }
    const bool is_kitti = looks_like_kitti_file(sequence.detections);
    std::map<std::int64_t, std::string> types;
    if (is_kitti) {  // which follow from whole tracks: all is tracked once more
      types = types_of_tracks(sequence, detections);
      detections.rewind();
    }
    std::vector<AtomicFile> files = files_of(sequence);
    SequenceRows filmed;
    std::string text;
    const BoxTracking result =
        follow(detections, filmed.detections, [&](std::span<const MotRow> rows) {
          text.clear();
          for (const MotRow& row : rows) {
            if (is_kitti) {
              const auto type = types.find(row.id);
              append_kitti_row(text, {row, type == types.end() ? "Misc" : type->second});
            } else {
              append_mot_row(text, row);
            }
          }
          for (AtomicFile& file : files) file.write(text);
          if (is_filmed()) filmed.tracks.insert(filmed.tracks.end(), rows.begin(), rows.end());
        });
    times_.of(StageTimes::kWrite, [&] {
      for (AtomicFile& file : files) file.commit();
      if (evaluation_) evaluation_->add(sequence, result.last_frame);
    });
    times_.count_scans(static_cast<std::size_t>(result.images));
    if (!manners_.quiet) tell("ghtrack: {}: {}", sequence.name, summary(config_.boxes, result));
    report_refusals(result.state, manners_);
    if (is_filmed()) film_sequence(options_, sequence, filmed, manners_);
  }

  void finish() const {
    if (evaluation_) evaluation_->finish();
  }

 private:
  bool is_filmed() const { return !options_.film.output.empty(); }

  /// Where the tracks of a sequence are written.
  std::vector<AtomicFile> files_of(const MotSequence& sequence) const {
    std::vector<AtomicFile> files;
    if (evaluation_) files.emplace_back(evaluation_->results_of(sequence));
    if (!evaluation_ || !options_.output.empty()) {
      const bool several = options_.detections.size() > 1;
      files.emplace_back(
          output_file(options_.output, several ? sequence.name + ".txt" : "tracks.txt"));
    }
    return files;
  }

  /// Tracks what is read.
  /// @param filmed  gets what was read if there is a film
  template <class OnRows>
  BoxTracking follow(MotReader& detections, std::vector<MotRow>& filmed, OnRows on_rows) const {
    const auto read = [&] {
      stop_if_interrupted();
      const auto rows = times_.of(StageTimes::kRead, [&] { return detections.next(); });
      if (is_filmed()) filmed.insert(filmed.end(), rows.begin(), rows.end());
      return rows;
    };
    return times_.of(StageTimes::kTrack, [&] {
      return track_boxes(config_.boxes, config_.box_output, read,
                         [&](std::span<const MotRow> rows) {
                           times_.of(StageTimes::kWrite, [&] { on_rows(rows); });
                         });
    });
  }

  std::map<std::int64_t, std::string> types_of_tracks(const MotSequence& sequence,
                                                      MotReader& detections) const {
    KittiReader labels(sequence.detections, MotKind::kDetections, stop_if_interrupted);
    TypeVotes votes(labels);
    const BoxSource read = [&] { return detections.next(); };
    times_.of(StageTimes::kTrack, [&] {
      track_boxes(config_.boxes, config_.box_output, read,
                  [&](std::span<const MotRow> rows) { votes.add(rows); });
    });
    return votes.types();
  }

  const TrackOptions& options_;
  const OfflineConfig& config_;
  StageTimes& times_;
  const Manners& manners_;
  std::optional<EvaluationFolder> evaluation_;
};

void track_sequences(const TrackOptions& options, const OfflineConfig& config, StageTimes& times,
                     const Manners& manners) {
  SequenceTracking tracking(options, config, times, manners);
  for (const std::string& path : options.detections) tracking.track(open_mot_sequence(path));
  tracking.finish();
}

/// What options say of points, instead of what the configuration says of all sensors or of one.
void change(OfflineConfig& config, const TrackOptions& options) {
  const auto apply = [&](OfflineSensor& sensor) {
    if (options.noise) sensor.noise = options.noise;
    if (options.noise) sensor.noise_y.reset();
    if (options.detection_probability) sensor.detection_probability = options.detection_probability;
    if (options.clutter) sensor.clutter = options.clutter;
  };
  apply(config);
  for (auto& [name, sensor] : config.sensors) apply(sensor);
  if (options.life_cycle.empty()) return;
  for (const auto& [name, life_cycle] : enum_names(LifeCycle{})) {
    if (name != options.life_cycle) continue;
    config.tracker.life_cycle = life_cycle;
    config.tracker.check([](std::string_view key, std::string_view message) {
      throw UsageError(fmt::format("track: with that --life-cycle, tracker.{}: {}", key, message));
    });
    return;
  }
  throw UsageError(fmt::format("track: --life-cycle is '{}'; allowed are existence and counts",
                               printable(options.life_cycle)));
}

/// Whether the input is boxes of MOTChallenge rather than points of a CSV file.
bool is_mot(const TrackOptions& options) {
  if (options.format != "auto") return options.format != "csv";
  std::error_code ignored;
  const std::string& first = options.detections.front();
  return fs::is_directory(first, ignored) ||
         (options.data.columns.empty() && looks_like_mot_file(first));
}

void check(const TrackOptions& options, bool boxes) {
  std::error_code ignored;
  for (const std::string* name : {&options.benchmark, &options.split, &options.tracker_name}) {
    if (name->empty() || name->find('/') != std::string::npos || name->front() == '.') {
      throw UsageError(fmt::format("track: '{}' cannot be the name of a folder", *name));
    }
  }
  if (options.plots && (boxes || options.output.empty() || options.output == "-")) {
    throw UsageError(boxes ? "track: --plots are of points; `ghtrack plot` draws boxes"
                           : "track: --plots lie beside the output; name it with -o");
  }
  const bool says_of_points = options.noise || options.detection_probability || options.clutter ||
                              !options.life_cycle.empty();
  if (boxes && says_of_points) {
    throw UsageError(
        "track: --noise, --pd, --clutter and --life-cycle are of points; boxes have `boxes` in "
        "--config");
  }
  const bool is_filmed = !options.film.output.empty();
  if (!is_filmed && (!options.film.background.empty() || !options.film.homography.empty())) {
    throw UsageError("track: --background and --homography are for --video");
  }
  if (options.detections.size() == 1) return;
  if (is_filmed) throw UsageError("track: --video shows one sequence; there are several");
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
  if (format != "auto" && format != "csv" && format != "mot" && format != "kitti") {
    throw UsageError(
        fmt::format("track: --format is '{}'; allowed are auto, csv, mot and kitti", format));
  }
  const bool boxes = is_mot(options);
  check(options, boxes);
  OfflineConfig config;
  if (!options.config.empty()) {
    config = schema::read_configuration_file<OfflineConfig>(options.config);
  }
  change(config, options);
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
