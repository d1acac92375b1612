#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ghtrack {

/// A file that appears under its name only when it is complete: it is written beside it as
/// `<name>.partial`, flushed to the disk and renamed by commit(). Without commit() or
/// keep_partial() nothing is left. A target that exists and is no regular file, such as a pipe or
/// /dev/stdout, is written directly. Every failure throws WriteError, and none is lost in a
/// destructor.
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
  void flush();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::filesystem::path written_path_;  // where the bytes go until commit()
  std::string buffer_;
  int descriptor_ = -1;
};

/// Writes a whole file at once.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Writes `<name>.partial` at once: what an interrupted run has to say.
void write_partial_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace ghtrack
