#include "tools/metrics/match_writer.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "tools/metrics/output.hpp"

namespace ghtrack {

MatchWriter::MatchWriter(std::filesystem::path path, bool with_sequence)
    : file_(std::move(path)), with_sequence_(with_sequence) {
  file_.write(with_sequence ? "sequence," : "");
  file_.write("t,truth_id,track_id,x_truth,y_truth,x,y,distance\n");
}

void MatchWriter::add(const std::string& sequence, double time,
                      const std::vector<PointMatch>& matches, const ScoredSet& truth,
                      const ScoredSet& tracks) {
  std::vector<const PointMatch*> of_truth(truth.ids.size()), of_track(tracks.ids.size());
  for (const PointMatch& match : matches) {
    of_truth[static_cast<std::size_t>(match.truth)] = &match;
    of_track[static_cast<std::size_t>(match.track)] = &match;
  }
  const auto write = [&](std::optional<std::size_t> object, std::optional<std::size_t> track,
                         std::optional<double> distance) {
    const auto identity = [&](const ScoredSet& set, std::optional<std::size_t> index) {
      if (index) {
        rows_ << set.ids[*index];
      } else {
        rows_ << std::optional<double>{};
      }
    };
    const auto position = [&](const ScoredSet& set, std::optional<std::size_t> index) {
      for (const int axis : {0, 1}) {
        rows_ << (index ? std::optional<double>(set.positions[*index][axis]) : std::nullopt);
      }
    };
    if (with_sequence_) rows_ << sequence;
    rows_ << time;
    identity(truth, object);
    identity(tracks, track);
    position(truth, object);
    position(tracks, track);
    rows_ << distance;
    rows_.end();
  };
  for (std::size_t i = 0; i < of_truth.size(); ++i) {
    const PointMatch* const match = of_truth[i];
    if (match == nullptr) {
      write(i, std::nullopt, std::nullopt);
    } else {
      write(i, static_cast<std::size_t>(match->track), match->distance);
    }
  }
  for (std::size_t i = 0; i < of_track.size(); ++i) {
    if (of_track[i] == nullptr) write(std::nullopt, i, std::nullopt);
  }
  file_.write(rows_.text());
  rows_.clear();
}

void MatchWriter::commit() { file_.commit(); }

RunMatches::RunMatches(std::filesystem::path path, const GospaOptions& options)
    : writer_(std::move(path), false), options_(options) {}

void RunMatches::add_tracks(const StepRecord& record) {
  if (record.contender != 0 || !record.is_in_order()) return;
  if (time_ && *time_ != record.truth.time) write_instant();
  time_ = record.truth.time;
  truth_.clear();
  tracks_.clear();
  for (const TruthState& object : record.truth.objects) truth_.add(object.id, object.position);
  for (const TrackEstimate& track : record.tracks.tracks) {
    if (counts_as_output(track)) tracks_.add(track.id, track.position);
  }
}

void RunMatches::write_instant() {
  if (!time_) return;
  const GospaResult sets = gospa(truth_.positions, tracks_.positions, options_);
  writer_.add("", *time_, sets.matches, truth_, tracks_);
  time_.reset();
}

void RunMatches::commit() {
  write_instant();
  writer_.commit();
}

}  // namespace ghtrack
