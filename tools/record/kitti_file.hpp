#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/record/mot_file.hpp"

namespace ghtrack {

/// A row of a label file of KITTI's tracking benchmark (Geiger, Lenz & Urtasun 2012): a box, which
/// counts images from 1 and has its first pixel at 1 here as MOTChallenge does, and what it shows.
struct KittiRow {
  MotRow box;
  std::string type;    // "Car", "Pedestrian", …
  int truncated = -1;  // 0: no, 1: partly, 2: largely outside of the image; −1: unknown
  int occluded = -1;   // 0: visible, 1: partly, 2: largely occluded; 3, −1: unknown
};

/// A file of labels, by frame.
struct KittiFile {
  std::vector<KittiRow> rows;
  std::vector<MotRow> unlabelled;  // regions of the truth in which nothing is labelled: `DontCare`
};

/// Whether a file holds such labels: its first line has 17 or 18 fields between blanks, the third
/// of which is a word.
bool looks_like_kitti_file(const std::filesystem::path& path);

/// Reads rows `frame id type truncated occluded alpha left top right bottom h w l x y z ry [score]`
/// in any order of frames; images count from 0 and pixels too.
/// @throws InputError naming file, line, what was found and what is allowed
KittiFile read_kitti_file(const std::filesystem::path& path, MotKind kind);

/// Appends a row; what a box does not tell has the values that KITTI gives to the unknown.
void append_kitti_row(std::string& text, const KittiRow& row);

}  // namespace ghtrack
