#include "tools/cli/number_table.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack::cli {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 18U;
constexpr std::size_t kLongestLine = std::size_t{1} << 16U;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

NumberTable::NumberTable(const std::string& file) : file_(file == "-" ? "standard input" : file) {
  descriptor_ = file == "-" ? STDIN_FILENO : open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw InputError(fmt::format("{}: error: {}", printable(file_), std::strerror(errno)));
  }
  do {
    if (!read_line()) fail("there are no measurements");
  } while (trimmed(line_).empty());
  if (line_.substr(0, 3) == "\xEF\xBB\xBF") line_.remove_prefix(3);
  if (number(trimmed(line_))) {
    columns_ = {"z"};
    header_is_data_ = true;
    return;
  }
  split();
  for (const std::string_view name : cells_) columns_.emplace_back(name);
}

NumberTable::~NumberTable() {
  if (descriptor_ > STDIN_FILENO) close(descriptor_);
}

std::optional<std::size_t> NumberTable::column(std::string_view name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

bool NumberTable::next() {
  if (!header_is_data_) {
    do {
      if (!read_line()) return false;
    } while (columns_.size() > 1 && trimmed(line_).empty());
  }
  header_is_data_ = false;
  split();
  if (cells_.size() != columns_.size()) {
    fail(fmt::format("the row has {} cells; the header has {}", cells_.size(), columns_.size()));
  }
  return true;
}

std::optional<double> NumberTable::cell(std::size_t column) const {
  const std::string_view text = cells_[column];
  if (text.empty()) return std::nullopt;
  const auto value = number(text);
  if (!value) {
    fail(fmt::format("column '{}' holds '{}', which is no number", printable(columns_[column]),
                     printable(text.substr(0, 40))));
  }
  return value;
}

void NumberTable::fail(const std::string& message) const {
  throw InputError(fmt::format("{}: error: {}", place(line_number_), message));
}

std::string NumberTable::place(long line) const {
  return fmt::format("{}:{}", printable(file_), line);
}

bool NumberTable::read_line() {
  for (;;) {
    const std::size_t end = buffer_.find('\n', begin_);
    if (end != std::string::npos) {
      line_ = std::string_view(buffer_).substr(begin_, end - begin_);
      begin_ = end + 1;
      ++line_number_;
      return true;
    }
    if (at_end_) {
      line_ = std::string_view(buffer_).substr(begin_);
      begin_ = buffer_.size();
      if (line_.empty()) return false;
      ++line_number_;
      return true;
    }
    buffer_.erase(0, begin_);
    begin_ = 0;
    if (buffer_.size() > kLongestLine) fail("the line is too long");
    const std::size_t kept = buffer_.size();
    buffer_.resize(kept + kBlock);
    ssize_t got = 0;
    do {
      stop_if_interrupted();
      got = read(descriptor_, buffer_.data() + kept, kBlock);
    } while (got < 0 && errno == EINTR);
    if (got < 0) {
      throw InputError(fmt::format("{}: error: {}", printable(file_), std::strerror(errno)));
    }
    buffer_.resize(kept + static_cast<std::size_t>(got));
    at_end_ = got == 0;
  }
}

void NumberTable::split() {
  cells_.clear();
  std::string_view rest = line_;
  for (;;) {
    const std::size_t comma = rest.find(',');
    cells_.push_back(trimmed(rest.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace ghtrack::cli
