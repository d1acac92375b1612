#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ghtrack {

/// One row of a MOTChallenge file (Leal-Taixé et al. 2015): a box in one image, in pixels, x right,
/// y down, the first pixel at 1.
struct MotRow {
  std::int32_t frame = 1;      // from 1
  std::int32_t category = -1;  // column 8 of ground truth with 9 columns; 1: pedestrian
  std::int64_t id = -1;        // −1: a detection
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;       // > 0
  double height = 0.0;      // > 0
  double confidence = 1.0;  // ground truth: 0 means that the row is not scored
};

/// What a MOTChallenge file holds, which decides what is allowed in it.
enum class MotKind {
  kDetections,  // id −1, any confidence, equal ids
  kTruth,       // no id twice in a frame among rows with another confidence than 0
  kResult,      // no id twice in a frame
};

/// Reads a MOTChallenge text file: rows `frame,id,left,top,width,height[,conf[,x,y,z]]` or, for
/// ground truth, `…,flag,category,visibility`, in any order of frames, separated by commas with or
/// without blanks, or by tabs. Empty lines are skipped. Rows come back by frame, in the file's
/// order. A file without rows is an empty list. Labels of KITTI are read as well.
/// @param last_frame  the length of the sequence if it is known: rows beyond it are errors
/// @throws InputError naming file, line, what was found and what is allowed
std::vector<MotRow> read_mot_file(const std::filesystem::path& path, MotKind kind,
                                  std::optional<std::int32_t> last_frame = std::nullopt);

/// Whether a file looks like a MOTChallenge file and not like a table of points: its first line has
/// at least six fields, of numbers or of the names `frame,id,…left,…`; or like labels of KITTI. An
/// unreadable or empty file does not.
bool looks_like_mot_file(const std::filesystem::path& path);

/// Appends `frame,id,left,top,width,height,confidence,-1,-1,-1`. Coordinates have two decimals, as
/// the evaluation kits write them.
void append_mot_row(std::string& text, const MotRow& row);

/// seqinfo.ini of a MOTChallenge sequence.
struct SequenceInfo {
  std::string name;
  double frame_rate = 30.0;  // [Hz]
  std::int32_t length = 0;   // frames
  int width = 0;             // of an image [pixel]
  int height = 0;
};

/// Reads the section [Sequence] of a seqinfo.ini: name, frameRate, seqLength, imWidth, imHeight;
/// other keys are ignored.
/// @throws InputError naming file, line, what was found and what is allowed
SequenceInfo read_sequence_info(const std::filesystem::path& path);

}  // namespace ghtrack
