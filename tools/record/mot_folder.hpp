#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/record/mot_file.hpp"

namespace ghtrack {

/// A sequence of MOTChallenge: either a folder with det/det.txt and, where they are there,
/// seqinfo.ini and gt/gt.txt, or a file of detections alone.
struct MotSequence {
  std::string name;
  std::filesystem::path detections;
  std::optional<std::filesystem::path> truth;
  std::optional<std::filesystem::path> info_file;
  std::optional<SequenceInfo> info;
};

/// Finds the parts of a sequence. Its name is that of the folder, or of the file without extension.
/// @throws InputError if a folder has no det/det.txt, or seqinfo.ini is wrong
MotSequence open_mot_sequence(const std::filesystem::path& path);

/// Where evaluation kits look for things, in the layout of TrackEval.
struct EvaluationLayout {
  std::filesystem::path root;
  std::string benchmark = "MOT15";
  std::string split = "train";
  std::string tracker = "ghtrack";
};

/// Writes truth and results where TrackEval expects them, so that it runs on the folder unchanged:
///   gt/<benchmark>-<split>/<sequence>/gt/gt.txt and seqinfo.ini, copied
///   gt/seqmaps/<benchmark>-<split>.txt
///   trackers/<benchmark>-<split>/<tracker>/data/<sequence>.txt
/// A sequence without truth has results only and is not in the seqmap. Without seqinfo.ini one is
/// made up from the last frame.
class EvaluationFolder {
 public:
  explicit EvaluationFolder(EvaluationLayout layout);

  /// The file that the results of a sequence are to be written into; its folder is made.
  /// @throws WriteError
  std::filesystem::path results_of(const MotSequence& sequence) const;

  /// Copies the truth of a sequence whose results are written.
  /// @param last_frame  of the detections, for a sequence without seqinfo.ini
  /// @throws WriteError
  void add(const MotSequence& sequence, std::int32_t last_frame);

  /// Writes the seqmap. The last call.
  /// @throws WriteError
  void finish() const;

 private:
  std::filesystem::path truth_folder() const;

  EvaluationLayout layout_;
  std::string set_;  // <benchmark>-<split>
  std::vector<std::string> scored_;
};

}  // namespace ghtrack
