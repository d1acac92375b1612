#include "tools/cli/video_place.hpp"

#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "tools/record/output_name.hpp"
#include "tools/render/errors.hpp"
#include "tools/render/output_path.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

fs::path target_of(const fs::path& wanted) {
  return render::is_picture_folder(wanted) ? fs::absolute(render::without_slash(wanted))
                                           : fs::absolute(followed(wanted));
}

}  // namespace

VideoPlace::VideoPlace(fs::path wanted)
    : wanted_(std::move(wanted)),
      target_(target_of(wanted_)),
      scratch_(Scratch::folder_in(target_.parent_path())) {}

fs::path VideoPlace::scratch_path() const {
  const fs::path path = scratch_.path() / target_.filename();
  return render::is_picture_folder(wanted_) ? path / "" : path;
}

void VideoPlace::commit() {
  if (render::is_picture_folder(wanted_)) return replace_folder();
  if (::rename(scratch_path().c_str(), target_.c_str()) != 0) fail(errno);
}

void VideoPlace::replace_folder() {
  const fs::path made = scratch_.path() / target_.filename();
  const auto rename = [](const fs::path& from, const fs::path& to, unsigned flags) {
    return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0;
  };
  if (!rename(made, target_, RENAME_EXCHANGE)) {
    if (errno != ENOENT || !rename(made, target_, 0)) fail(errno);
    return;
  }
  // The older folder lies in the scratch folder now and goes with it: look once more what it holds.
  try {
    render::check_picture_folder(made / "");
  } catch (...) {
    rename(made, target_, RENAME_EXCHANGE);
    throw;
  }
}

void VideoPlace::keep_partial() {
  const fs::path partial = render::partial_path(scratch_path()).filename();
  std::error_code error;
  fs::rename(scratch_.path() / partial, target_.parent_path() / partial, error);
  const bool exists = error != std::errc::no_such_file_or_directory;  // not without a frame
  if (error && exists) fail(error.value());
}

void VideoPlace::fail(int error) const {
  throw render::OutputError("cannot write '" + wanted_.string() +
                            "': " + std::generic_category().message(error));
}

}  // namespace ghtrack::cli
