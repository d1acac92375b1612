#pragma once

#include <cstddef>
#include <filesystem>

namespace ghtrack::render {

/// The place of a video that is being written: it has a partial name until it is complete and has
/// been read back, and is removed if nobody wants it.
class UnfinishedVideo {
 public:
  explicit UnfinishedVideo(const std::filesystem::path& path);
  ~UnfinishedVideo();
  UnfinishedVideo(const UnfinishedVideo&) = delete;
  UnfinishedVideo& operator=(const UnfinishedVideo&) = delete;

  /// Where it is written to.
  const std::filesystem::path& partial() const { return partial_; }

  /// Verifies what has been written and gives it its name.
  /// @param frames  that it has to hold
  /// @throws OutputError, as keep(), if it does not
  void commit(std::size_t frames);

  /// Verifies what has been written and leaves it under its partial name. Of nothing nothing is
  /// kept.
  void keep(std::size_t frames);

 private:
  void verify(std::size_t frames) const;

  std::filesystem::path path_;
  std::filesystem::path partial_;
  bool is_wanted_ = false;
};

}  // namespace ghtrack::render
