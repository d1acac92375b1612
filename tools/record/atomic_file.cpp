#include "tools/record/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "tools/record/errors.hpp"
#include "tools/record/output_name.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  buffer_.reserve(kBufferSize);
  if (const auto own = own_descriptor(path_, STDOUT_FILENO)) {
    if (*own == STDOUT_FILENO) std::fflush(stdout);
    descriptor_ = ::fcntl(*own, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  replaced_ = followed(path_);
  struct stat about {};
  const bool is_there = ::stat(replaced_.c_str(), &about) == 0;
  if (is_there && S_ISDIR(about.st_mode)) fail(EISDIR);
  if (is_there && !S_ISREG(about.st_mode)) {
    descriptor_ = ::open(replaced_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  if (is_there && ::access(replaced_.c_str(), W_OK) != 0) fail(errno);
  open_scratch();
  if (is_there) ::fchmod(descriptor_, about.st_mode & 07777U);
}

void AtomicFile::open_scratch() {
  try {
    scratch_.emplace(Scratch::file_beside(replaced_, descriptor_));
  } catch (const WriteError&) {
    fail(errno);  // in the name that the user gave
  }
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      replaced_(std::move(other.replaced_)),
      scratch_(std::move(other.scratch_)),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AtomicFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > kBufferSize) flush();
  if (bytes.size() > kBufferSize) return put(bytes);
  buffer_.append(bytes);
}

void AtomicFile::flush() {
  put(buffer_);
  buffer_.clear();
}

void AtomicFile::put(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      fail(errno);
    }
  }
}

void AtomicFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

void AtomicFile::rename_to(const std::filesystem::path& name) {
  if (::rename(scratch_->path().c_str(), name.c_str()) != 0) fail(errno);
  scratch_->release();
}

void AtomicFile::commit() {
  flush();
  // Pipes and devices cannot be synchronised, which is no failure.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
  close();
  if (scratch_) rename_to(replaced_);
}

void AtomicFile::keep_partial() {
  flush();
  close();
  if (!scratch_) return;
  std::filesystem::path partial = replaced_;
  partial += ".partial";
  rename_to(partial);
}

void AtomicFile::fail(int error) const {
  throw WriteError(path_ == "-" ? "standard output" : path_, error);
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
