// NumberFile where there are no files: in a browser.

#include <algorithm>
#include <vector>

#include "tools/record/number_file.hpp"

namespace ghtrack {

struct NumberFile::Store {
  std::vector<double> numbers;
};

NumberFile::NumberFile() : store_(std::make_unique<Store>()) {}
NumberFile::NumberFile(const std::string& /*folder*/) : NumberFile() {}
NumberFile::~NumberFile() = default;
NumberFile::NumberFile(NumberFile&& other) noexcept = default;

void NumberFile::write(std::uint64_t place, std::span<const double> numbers) {
  std::vector<double>& all = store_->numbers;
  all.resize(std::max<std::size_t>(all.size(), place + numbers.size()));
  std::copy(numbers.begin(), numbers.end(), all.begin() + static_cast<std::ptrdiff_t>(place));
}

void NumberFile::read(std::uint64_t place, std::span<double> numbers) const {
  std::copy_n(store_->numbers.begin() + static_cast<std::ptrdiff_t>(place), numbers.size(),
              numbers.begin());
}

}  // namespace ghtrack
