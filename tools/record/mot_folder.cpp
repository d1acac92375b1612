#include "tools/record/mot_folder.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "tools/record/atomic_file.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

/// The same path; its folder is made.
fs::path in_new_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error) {
    throw WriteError(path.parent_path().string() +
                     ": error: the folder cannot be made: " + error.message());
  }
  return path;
}

}  // namespace

MotSequence open_mot_sequence(const fs::path& path) {
  MotSequence sequence;
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) {
    sequence.name = path.stem().string();
    sequence.detections = path;
    return sequence;
  }
  const fs::path folder = path.filename().empty() ? path.parent_path() : path;
  sequence.name = fs::absolute(folder, ignored).lexically_normal().filename().string();
  sequence.detections = folder / "det" / "det.txt";
  if (!is_file(sequence.detections)) {
    throw InputError(folder.string() + ": error: a sequence folder must hold det/det.txt");
  }
  if (is_file(folder / "gt" / "gt.txt")) sequence.truth = folder / "gt" / "gt.txt";
  if (is_file(folder / "seqinfo.ini")) {
    sequence.info_file = folder / "seqinfo.ini";
    sequence.info = read_sequence_info(*sequence.info_file);
  }
  return sequence;
}

EvaluationFolder::EvaluationFolder(EvaluationLayout layout)
    : layout_(std::move(layout)), set_(layout_.benchmark + "-" + layout_.split) {}

fs::path EvaluationFolder::truth_folder() const { return layout_.root / "gt"; }

fs::path EvaluationFolder::results_of(const MotSequence& sequence) const {
  return in_new_folder(layout_.root / "trackers" / set_ / layout_.tracker / "data" /
                       (sequence.name + ".txt"));
}

void EvaluationFolder::add(const MotSequence& sequence, std::int32_t last_frame) {
  if (!sequence.truth) return;
  const fs::path folder = truth_folder() / set_ / sequence.name;
  write_file(in_new_folder(folder / "gt" / "gt.txt"), read_text_file(*sequence.truth));
  write_file(folder / "seqinfo.ini",
             sequence.info_file
                 ? read_text_file(*sequence.info_file)
                 : fmt::format("[Sequence]\nname={}\nseqLength={}\n", sequence.name, last_frame));
  scored_.push_back(sequence.name);
}

void EvaluationFolder::finish() const {
  std::string seqmap = "name\n";
  for (const std::string& name : scored_) seqmap += name + "\n";
  write_file(in_new_folder(truth_folder() / "seqmaps" / (set_ + ".txt")), seqmap);
}

}  // namespace ghtrack
