#include "tools/record/number_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "tools/record/errors.hpp"
#include "tools/record/scratch.hpp"

namespace ghtrack {

struct NumberFile::Store {
  std::string folder;
  int descriptor = -1;

  ~Store() {
    if (descriptor >= 0) ::close(descriptor);
  }

  [[noreturn]] void fail() const { throw WriteError(folder, errno); }
};

NumberFile::NumberFile() : NumberFile(std::filesystem::temp_directory_path().string()) {}

NumberFile::NumberFile(const std::string& folder) : store_(std::make_unique<Store>()) {
  store_->folder = folder;
  // Gone at once, but still open.
  Scratch::file_beside(std::filesystem::path(folder) / "numbers", store_->descriptor);
}

NumberFile::~NumberFile() = default;
NumberFile::NumberFile(NumberFile&& other) noexcept = default;

void NumberFile::write(std::uint64_t place, std::span<const double> numbers) {
  auto bytes = std::as_bytes(numbers);
  for (auto at = static_cast<off_t>(place * sizeof(double)); !bytes.empty();) {
    const ssize_t written = ::pwrite(store_->descriptor, bytes.data(), bytes.size(), at);
    if (written < 0 && errno != EINTR) store_->fail();
    if (written <= 0) continue;
    at += written;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void NumberFile::read(std::uint64_t place, std::span<double> numbers) const {
  auto bytes = std::as_writable_bytes(numbers);
  for (auto at = static_cast<off_t>(place * sizeof(double)); !bytes.empty();) {
    const ssize_t got = ::pread(store_->descriptor, bytes.data(), bytes.size(), at);
    if (got == 0) throw std::logic_error("a number was read that had not been written");
    if (got < 0 && errno != EINTR) store_->fail();
    if (got < 0) continue;
    at += got;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

}  // namespace ghtrack
