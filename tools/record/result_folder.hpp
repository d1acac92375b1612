#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/record/scratch.hpp"

namespace ghtrack {

/// The folder of a result that consists of several files, which appear in it together: they are
/// made in a scratch folder inside it, and commit() gives all of them their names, or none. While
/// this lives no other process can do the same in this folder. Files that are not made again stay.
class ResultFolder {
 public:
  /// Makes the folder and its parents where they are missing.
  /// @throws WriteError if it cannot be made, or another process is writing into it
  explicit ResultFolder(std::filesystem::path folder);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }

  /// Where the files are made, under the names that they shall have.
  const std::filesystem::path& scratch() const { return scratch_->path(); }

  /// Puts every file of the scratch folder into the folder, in place of older ones of that name;
  /// a symbolic link of that name is replaced, not followed. The last call.
  /// @throws WriteError if one of them cannot be put there; then the older ones stand again
  void commit();

  /// Puts only what is called `….partial…` there: what an interrupted run has to say. The last
  /// call.
  void keep_partial();

 private:
  void lock();
  void remove_stale_scratch() const;
  std::vector<std::string> made(bool partial_only) const;
  void put(const std::vector<std::string>& names);

  std::filesystem::path folder_;
  int descriptor_ = -1;  // of the folder; holds the lock
  std::optional<Scratch> scratch_;
};

/// Makes a folder and its parents.
/// @throws WriteError naming the folder and the reason
void make_folder(const std::filesystem::path& folder);

}  // namespace ghtrack
