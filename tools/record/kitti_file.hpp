#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "tools/record/mot_file.hpp"
#include "tools/record/text_file.hpp"

namespace ghtrack {

/// A row of a label file of KITTI's tracking benchmark (Geiger, Lenz & Urtasun 2012): a box, which
/// counts images from 1 and has its first pixel at 1 here as MOTChallenge does, and what it shows.
struct KittiRow {
  MotRow box;
  std::string type;    // "Car", "Pedestrian", …
  int truncated = -1;  // 0: no, 1: partly, 2: largely outside of the image; −1: unknown
  int occluded = -1;   // 0: visible, 1: partly, 2: largely occluded; 3, −1: unknown
};

/// The type of a region of the truth in which nothing is labelled.
inline constexpr std::string_view kNotLabelled = "DontCare";

/// Whether a file holds such labels: its first line has 17 or 18 fields between blanks, the third
/// of which is a word.
bool looks_like_kitti_file(const std::filesystem::path& path);

/// Understands a line `frame id type truncated occluded alpha left top right bottom h w l x y z ry
/// [score]`; images count from 0 and pixels too.
/// @return absent if the line is blank or wrong, which is then among the findings
std::optional<KittiRow> parse_kitti_row(std::string_view line, std::int64_t line_number,
                                        Findings& findings);

/// Reads labels frame by frame: in constant memory if the file is in the order of frames; the rows
/// of others are held in memory.
class KittiReader {
 public:
  /// Goes through the file once.
  /// @param pause  called between blocks; may throw to stop reading
  /// @throws InputError naming file, line, what was found and what is allowed
  KittiReader(const std::filesystem::path& path, MotKind kind, std::function<void()> pause = {});
  ~KittiReader();
  KittiReader(KittiReader&&) noexcept;

  bool in_order() const;                       // of frames, in the file
  const std::set<std::string>& types() const;  // of all rows

  /// The rows of the next frame, in the order of the file, valid until the next call; empty after
  /// the last.
  /// @throws InputError if an object is there twice
  std::span<const KittiRow> next();

  /// Goes back to the first frame.
  void rewind();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Appends a row; what a box does not tell has the values that KITTI gives to the unknown.
void append_kitti_row(std::string& text, const KittiRow& row);

}  // namespace ghtrack
