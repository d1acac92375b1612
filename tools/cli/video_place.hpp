#pragma once

#include <filesystem>

#include "tools/record/scratch.hpp"

namespace ghtrack::cli {

/// Where a video is made until it is complete: a scratch folder beside the file, or the folder of
/// pictures, that it is to become.
class VideoPlace {
 public:
  /// @param wanted  the file, or a folder if it ends with a slash
  /// @throws RequestError, OutputError if that cannot be written
  explicit VideoPlace(std::filesystem::path wanted);

  /// What is to be written instead of it.
  std::filesystem::path scratch_path() const;

  /// Gives the complete video its name. An older video, or a folder of such pictures, is replaced;
  /// nothing else ever is.
  void commit();

  /// Keeps what an interrupted run has drawn, as `<stem>.partial.<extension>`.
  void keep_partial();

 private:
  void replace_folder();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path wanted_;
  std::filesystem::path target_;  // links followed, no slash at the end
  Scratch scratch_;
};

}  // namespace ghtrack::cli
