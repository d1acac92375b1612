#pragma once

#include <filesystem>

#include "tools/render/libav.hpp"

namespace ghtrack::render {

/// An MP4 file with one video. It is whole only after close(), with its index in front.
class Mp4File {
 public:
  /// @param codec  of all that is added
  /// @throws OutputError, as all here, if it cannot be written
  Mp4File(const std::filesystem::path& path, const AVCodecContext& codec);
  ~Mp4File();
  Mp4File(const Mp4File&) = delete;
  Mp4File& operator=(const Mp4File&) = delete;

  /// Appends images; their times are in the codec's units.
  void add(const libav::Packets& packets);
  void close();

 private:
  void check(int result) const;

  std::filesystem::path path_;
  AVRational unit_;  // [s] of the codec's times
  AVFormatContext* file_ = nullptr;
};

}  // namespace ghtrack::render
