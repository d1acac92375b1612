#include "tools/record/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), written_path_(path_) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path_, ignored);
  if (std::filesystem::is_directory(status)) fail(EISDIR);
  if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)) {
    written_path_ += ".partial";
  }
  descriptor_ = ::open(written_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
  buffer_.reserve(kBufferSize);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      written_path_(std::move(other.written_path_)),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  if (written_path_ != path_) ::unlink(written_path_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > kBufferSize) flush();
  buffer_.append(bytes);
}

void AtomicFile::flush() {
  for (std::string_view rest = buffer_; !rest.empty();) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
  buffer_.clear();
}

void AtomicFile::commit() {
  flush();
  // Pipes and devices cannot be synchronised, which is no failure.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
  const bool closed = ::close(std::exchange(descriptor_, -1)) == 0;
  if (written_path_ == path_) {
    if (!closed) fail(errno);
  } else if (!closed || ::rename(written_path_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    ::unlink(written_path_.c_str());
    fail(error);
  }
}

void AtomicFile::keep_partial() {
  flush();
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

void AtomicFile::fail(int error) const {
  throw WriteError(path_.string() +
                   ": error: cannot write: " + std::generic_category().message(error));
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_partial_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.keep_partial();
}

}  // namespace ghtrack
