#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace ghtrack {

/// A file for numbers that has no name, so that it vanishes with its process. In a browser, which
/// has no files, it lies in memory.
class NumberFile {
 public:
  /// In the system's folder for such files.
  NumberFile();
  /// @param folder  where it takes up room
  /// @throws WriteError naming the folder; so do the others
  explicit NumberFile(const std::string& folder);
  ~NumberFile();
  NumberFile(NumberFile&& other) noexcept;
  NumberFile(const NumberFile&) = delete;
  NumberFile& operator=(NumberFile&&) = delete;
  NumberFile& operator=(const NumberFile&) = delete;

  /// @param place  of the first of them, counted in numbers
  void write(std::uint64_t place, std::span<const double> numbers);
  void read(std::uint64_t place, std::span<double> numbers) const;

 private:
  struct Store;
  std::unique_ptr<Store> store_;
};

}  // namespace ghtrack
