#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace ghtrack {

/// A file for numbers that has no name, so that it vanishes with its process.
class NumberFile {
 public:
  /// @param folder  where it takes up room
  /// @throws WriteError naming the folder; so do the others
  explicit NumberFile(const std::filesystem::path& folder);
  ~NumberFile();
  NumberFile(NumberFile&& other) noexcept;
  NumberFile(const NumberFile&) = delete;
  NumberFile& operator=(NumberFile&&) = delete;
  NumberFile& operator=(const NumberFile&) = delete;

  /// @param place  of the first of them, counted in numbers
  void write(std::uint64_t place, std::span<const double> numbers);
  void read(std::uint64_t place, std::span<double> numbers) const;

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path folder_;
  int descriptor_ = -1;
};

}  // namespace ghtrack
