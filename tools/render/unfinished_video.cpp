#include "tools/render/unfinished_video.hpp"

#include <string>
#include <system_error>

#include "tools/render/encoder.hpp"
#include "tools/render/output_path.hpp"

namespace ghtrack::render {

namespace fs = std::filesystem;

UnfinishedVideo::UnfinishedVideo(const fs::path& path)
    : path_(path), partial_(partial_path(path)) {}

UnfinishedVideo::~UnfinishedVideo() {
  std::error_code ignored;
  if (!is_wanted_) fs::remove_all(partial_, ignored);
}

void UnfinishedVideo::commit(std::size_t frames) {
  if (frames == 0) throw OutputError("cannot write '" + path_.string() + "': it has no frames");
  verify(frames);
  commit_file(partial_, path_);
  is_wanted_ = true;
}

void UnfinishedVideo::keep(std::size_t frames) {
  if (frames == 0) return;
  verify(frames);
  is_wanted_ = true;
}

void UnfinishedVideo::verify(std::size_t frames) const {
  const bool is_video = !is_picture_folder(path_) && path_.extension() != ".png";
  if (is_video) verify_video(partial_, frames);  // pictures were verified one by one
}

}  // namespace ghtrack::render
