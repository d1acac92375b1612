#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
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

/// Boxes frame by frame: the rows of the next frame that has any, valid until the next call; empty
/// after the last.
using BoxSource = std::function<std::span<const MotRow>()>;

/// Boxes in memory.
/// @param rows  by frame
BoxSource frames_of(std::span<const MotRow> rows);

/// Reads a MOTChallenge text file frame by frame: rows
/// `frame,id,left,top,width,height[,conf[,x,y,z]]` or, for ground truth,
/// `…,flag,category,visibility`, separated by commas with or without blanks, by semicolons, tabs or
/// blanks; empty fields at the end are none. Below a
/// header row with names, the columns are known by these (BoxFields), in any order and among
/// others, and frames may count from 0. Empty lines are skipped. The rows of a frame have the
/// file's order. Labels of KITTI are read as well.
///
/// A file in the order of frames is read in constant memory, whatever its size; the rows of others,
/// and of pipes, are held in memory.
class MotReader {
 public:
  /// Goes through the file once.
  /// @param last_frame  the length of the sequence if it is known: rows beyond it are errors
  /// @param pause       called between blocks; may throw to stop reading
  /// @throws InputError naming file, line, what was found and what is allowed
  MotReader(const std::filesystem::path& path, MotKind kind,
            std::optional<std::int32_t> last_frame = std::nullopt,
            std::function<void()> pause = {});
  ~MotReader();
  MotReader(MotReader&&) noexcept;

  std::int64_t rows() const;
  bool in_order() const;          // of frames, in the file
  bool counts_from_zero() const;  // the frames of a table with names; given from 1 as others
  bool has_categories() const;    // some rows have one

  /// The rows of the next frame, valid until the next call; empty after the last.
  /// @throws InputError if an identity is there twice
  std::span<const MotRow> next();

  /// Goes back to the first frame.
  void rewind();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a whole file with MotReader: rows by frame, in the file's order.
std::vector<MotRow> read_mot_file(const std::filesystem::path& path, MotKind kind,
                                  std::optional<std::int32_t> last_frame = std::nullopt);

/// Whether a file looks like a MOTChallenge file and not like a table of points: its first line has
/// at least six fields, of numbers or of the names `frame,id,…left,…`, or it names those of a
/// box; or it has the numbers of a box between blanks; or it looks like labels of KITTI. An
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
