#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "tools/record/scratch.hpp"

namespace ghtrack {

/// A file that appears under its name only when it is complete: it is written beside it under a
/// name of its own, flushed to the disk and renamed by commit(). Without commit() or keep_partial()
/// nothing is left. Every failure throws WriteError, and none is lost in a destructor.
///
/// A symbolic link stays, and the file that it leads to is replaced. A file that is there keeps its
/// permissions. What is no regular file, such as a pipe or a device, is written directly, and so is
/// a descriptor of this process: `-`, /dev/stdout, /dev/fd/N.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(AtomicFile&&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes. Small writes are gathered.
  void write(std::string_view bytes);

  /// Completes the file and gives it its name. The last call.
  void commit();

  /// Keeps what has been written so far as `<name>.partial`. The last call.
  void keep_partial();

  const std::filesystem::path& path() const { return path_; }

 private:
  void open_scratch();
  void flush();
  void put(std::string_view bytes);
  void close();
  void rename_to(const std::filesystem::path& name);
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;      // as given
  std::filesystem::path replaced_;  // the file that gets replaced: links followed
  std::optional<Scratch> scratch_;  // where the bytes go until commit(); nothing: straight to path_
  std::string buffer_;
  int descriptor_ = -1;
};

/// Writes a whole file at once.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Writes `<name>.partial` at once: what an interrupted run has to say.
void write_partial_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace ghtrack
