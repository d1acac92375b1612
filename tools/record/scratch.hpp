#pragma once

#include <filesystem>

namespace ghtrack {

/// A file or folder that stands only while something is being made. Nobody else has its name, and
/// making it follows no link. It is removed at the end of its scope, and by remove_all_scratch()
/// where a process has to end at once. One that kill -9 leaves behind stands in nobody's way.
class Scratch {
 public:
  /// A new, empty file `<name>.<letters>.partial` beside `target`, and a descriptor to write it.
  /// @throws WriteError naming the target
  static Scratch file_beside(const std::filesystem::path& target, int& descriptor);

  /// A new folder `.ghtrack-<letters>.partial` in a folder.
  /// @throws WriteError naming the folder
  static Scratch folder_in(const std::filesystem::path& folder);

  ~Scratch();
  Scratch(Scratch&& other) noexcept;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(Scratch&&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// It has got another name, or is to stay.
  void release();

  /// Whether a name is one that folder_in() gives.
  static bool is_folder_name(const std::filesystem::path& name);

 private:
  explicit Scratch(std::filesystem::path path);

  std::filesystem::path path_;
  int slot_ = -1;  // in the list of what a process that ends at once removes
};

/// Removes every scratch file and folder of this process with what is in it. Safe to be called by
/// a signal handler; the process must end then.
void remove_all_scratch() noexcept;

}  // namespace ghtrack
