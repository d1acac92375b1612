#include "tools/record/number_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "tools/record/errors.hpp"
#include "tools/record/scratch.hpp"

namespace ghtrack {

NumberFile::NumberFile(const std::filesystem::path& folder) : folder_(folder) {
  Scratch::file_beside(folder / "numbers", descriptor_);  // gone at once, but still open
}

NumberFile::~NumberFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

NumberFile::NumberFile(NumberFile&& other) noexcept
    : folder_(std::move(other.folder_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

void NumberFile::write(std::uint64_t place, std::span<const double> numbers) {
  auto bytes = std::as_bytes(numbers);
  for (auto at = static_cast<off_t>(place * sizeof(double)); !bytes.empty();) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), at);
    if (written < 0 && errno != EINTR) fail();
    if (written <= 0) continue;
    at += written;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void NumberFile::read(std::uint64_t place, std::span<double> numbers) const {
  auto bytes = std::as_writable_bytes(numbers);
  for (auto at = static_cast<off_t>(place * sizeof(double)); !bytes.empty();) {
    const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), at);
    if (got == 0) throw std::logic_error("a number was read that had not been written");
    if (got < 0 && errno != EINTR) fail();
    if (got < 0) continue;
    at += got;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

void NumberFile::fail() const {
  throw WriteError(folder_.string() +
                   ": error: cannot write: " + std::generic_category().message(errno));
}

}  // namespace ghtrack
