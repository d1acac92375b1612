#include "tools/record/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>

#include "scenes/schema/utf8.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/output_name.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kLongestFile = std::size_t{256} << 20;
constexpr std::int64_t kLargestWhole = std::int64_t{1} << 53;

/// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int value() const { return value_; }

 private:
  int value_;
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw InputError(input_name(path) + ": error: " + reason);
}

[[noreturn]] void refuse_unreadable(const std::filesystem::path& path) {
  refuse(path, "cannot read: " + std::generic_category().message(errno));
}

/// Appends what an open file holds, up to its end.
void read_all(const std::filesystem::path& path, int descriptor, std::string& text) {
  constexpr std::size_t kBlock = std::size_t{1} << 18;
  for (std::size_t filled = text.size();;) {
    text.resize(filled + kBlock);
    const ssize_t got = ::read(descriptor, text.data() + filled, kBlock);
    if (got < 0) refuse_unreadable(path);  // also when a signal ends the waiting
    filled += static_cast<std::size_t>(got);
    text.resize(filled);
    if (got == 0) return;
    if (filled > kLongestFile) refuse(path, "longer than 256 MiB");
  }
}

std::string read_file(const std::filesystem::path& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat about {};
  if (file.value() < 0 || ::fstat(file.value(), &about) != 0) refuse_unreadable(path);
  if (!S_ISREG(about.st_mode)) {
    refuse(path, "this is no regular file; what comes through a pipe is read with '-'");
  }
  if (about.st_size > static_cast<off_t>(kLongestFile)) refuse(path, "longer than 256 MiB");
  std::string text;
  text.reserve(static_cast<std::size_t>(about.st_size) + 1);
  read_all(path, file.value(), text);
  return text;
}

/// A stream can be read once only, so what came is kept for whoever asks again.
const std::string& read_stream(const std::filesystem::path& path, int descriptor) {
  static std::map<int, std::string> read_before;
  const auto [text, is_new] = read_before.try_emplace(descriptor);
  if (is_new) read_all(path, descriptor, text->second);
  return text->second;
}

/// Length of the character at the start of the text if it is one that a text may hold: UTF-8, no
/// control character but tab and line ends; else 0.
std::size_t text_character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) {
    return lead >= 0x20 && lead != 0x7f ? 1 : lead == '\t' || lead == '\n' || lead == '\r';
  }
  const auto character = schema::first_character(text);
  return character ? character->size : 0;
}

[[noreturn]] void refuse_at(const std::filesystem::path& path, std::string_view text,
                            std::size_t offset, const std::string& reason) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(offset);
  const auto line = 1 + std::count(text.begin(), end, '\n');
  throw InputError(input_name(path) + ":" + std::to_string(line) + ": error: " + reason);
}

void check_text(const std::filesystem::path& path, std::string_view text) {
  std::size_t line_start = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = text_character(text.substr(i));
    if (length == 0) {
      refuse_at(path, text, i, "this is no text: a control character, or a byte that is not UTF-8");
    }
    if (text[i] == '\n') {
      line_start = i + 1;
    } else if (i - line_start > kLongestLine) {
      refuse_at(path, text, i, "this line is longer than 64 KiB");
    }
    i += length;
  }
}

/// Whether a character shows, and leaves the order of its neighbours alone.
bool shows(char32_t code) {
  const bool turns = (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
                     (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
  return !schema::is_control(code) && !turns;
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes a quoted field off the front of `line`, which starts with the quote. A field whose quote
/// is not closed stays as it is, quote included.
std::string_view take_quoted(std::string_view& line, std::vector<std::string>& owned) {
  std::string value;
  std::size_t i = 1;
  for (; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (i + 1 == line.size() || line[i + 1] != '"') break;
      ++i;
    }
    value += line[i];
  }
  if (i == line.size()) return std::exchange(line, {});
  line.remove_prefix(i + 1);
  return owned.emplace_back(std::move(value));
}

/// Takes a number of at most 15 digits without exponent off a text, which one exact division makes
/// exact (Clinger 1990). Almost every cell of a table is one.
/// @returns where it ends; null if the text starts with anything else
const char* take_short_decimal(const char* at, const char* end, char point, double& value) {
  constexpr double kPowers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  std::uint64_t digits = 0;
  const auto take_digits = [&] {
    const char* const begin = at;
    for (; at != end; ++at) {
      const auto digit = static_cast<unsigned>(*at - '0');
      if (digit > 9) break;
      digits = 10 * digits + digit;
    }
    return at - begin;
  };
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  std::ptrdiff_t count = take_digits();
  std::ptrdiff_t decimals = 0;
  if (at != end && *at == point) {
    ++at;
    decimals = take_digits();
    count += decimals;
  }
  if (count == 0 || count > 15) return nullptr;
  value = static_cast<double>(static_cast<std::int64_t>(digits));
  if (decimals > 0) value /= kPowers[decimals];
  if (negative) value = -value;
  return at;
}

}  // namespace

void Findings::add(std::int64_t line, std::string_view message, std::int64_t column) {
  if (enough()) return;
  std::string text = file_ + ":";
  if (line > 0) text += std::to_string(line) + ":";
  if (column > 0) text += std::to_string(column) + ":";
  lines_.push_back(text + " error: " + std::string(message));
}

void Findings::throw_if_any() const {
  if (lines_.empty()) return;
  std::string text;
  for (const std::string& line : lines_) text += (text.empty() ? "" : "\n") + line;
  if (enough()) text += "\n" + file_ + ": error: reading stopped after these findings";
  throw InputError(text);
}

std::string input_name(const std::filesystem::path& path) {
  return path == "-" ? "standard input" : path.string();
}

std::string read_text_file(const std::filesystem::path& path) {
  const std::optional<int> own = own_descriptor(path, STDIN_FILENO);
  std::string text = own ? read_stream(path, *own) : read_file(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  check_text(path, text);
  return text;
}

std::optional<std::string_view> Lines::next() {
  if (rest_.empty()) return std::nullopt;
  ++number_;
  const std::size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

void split_fields(std::string_view line, std::vector<std::string_view>& fields,
                  std::vector<std::string>& owned) {
  fields.clear();
  owned.clear();
  // Views into `owned` stay valid because it never grows beyond this.
  const auto quotes = static_cast<std::size_t>(std::count(line.begin(), line.end(), '"'));
  owned.reserve(quotes);
  const char separator = line.find(';') != std::string_view::npos   ? ';'
                         : line.find(',') != std::string_view::npos ? ','
                                                                    : '\t';
  while (true) {
    const std::size_t start = quotes == 0 ? std::string_view::npos
                                          : line.find_first_not_of(separator == '\t' ? " " : " \t");
    std::string_view field;
    if (start != std::string_view::npos && line[start] == '"') {
      line.remove_prefix(start);
      field = take_quoted(line, owned);
    }
    const std::size_t end = line.find(separator);
    const std::string_view plain = trimmed(line.substr(0, end));
    if (field.data() == nullptr || !plain.empty()) field = plain;  // text after a quote shows up
    fields.push_back(field);
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

bool is_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = text_character(text.substr(i));
    if (length == 0) return false;
    i += length;
  }
  return true;
}

std::optional<double> parse_number(std::string_view text, char point) {
  const char* const text_end = text.data() + text.size();
  double value = 0.0;
  if (take_short_decimal(text.data(), text_end, point, value) == text_end && !text.empty()) {
    return value;
  }
  if (point != '.') {
    if (text.find('.') != std::string_view::npos) return std::nullopt;
    std::string with_point(text);
    std::replace(with_point.begin(), with_point.end(), point, '.');
    return parse_number(with_point);
  }
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text_end, value);
  if (error != std::errc() || end != text_end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::size_t plain_numbers(std::string_view line, std::span<double> numbers) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t count = 0; count < numbers.size();) {
    while (at != end && is_blank(*at)) ++at;
    at = take_short_decimal(at, end, '.', numbers[count]);
    if (at == nullptr) return 0;
    ++count;
    if (at == end) return count;
    if (*at++ != ',') return 0;
  }
  return 0;
}

std::optional<std::int64_t> parse_whole(std::string_view text) {
  const std::optional<double> value = parse_number(text);
  return value ? as_whole(*value) : std::nullopt;
}

std::optional<std::int64_t> as_whole(double value) {
  if (!(std::abs(value) <= kLargestWhole)) return std::nullopt;
  const auto whole = static_cast<std::int64_t>(value);
  if (static_cast<double>(whole) != value) return std::nullopt;
  return whole;
}

void append_hundredths(std::string& text, double value) {
  const double hundredths = std::abs(value) * 100.0;
  const double nearest = std::floor(hundredths + 0.5);
  // Near a tie the digits decide that the product has rounded away.
  const bool is_clear = hundredths < 1e12 && std::abs(std::abs(hundredths - nearest) - 0.5) > 1e-3;
  if (!is_clear) {
    fmt::format_to(std::back_inserter(text), "{:.2f}", value);
    return;
  }
  const auto whole = static_cast<std::int64_t>(nearest);
  if (std::signbit(value)) text += '-';
  const fmt::format_int integer(whole / 100);
  text.append(integer.data(), integer.size());
  const auto decimals = static_cast<char>(whole % 100);
  text += {'.', static_cast<char>('0' + decimals / 10), static_cast<char>('0' + decimals % 10)};
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string result = "'";
  std::size_t count = 0;
  while (!text.empty() && count++ < kMost) {
    const auto character = schema::first_character(text);
    const std::size_t size = character ? character->size : 1;
    result += character && shows(character->code) ? text.substr(0, size) : "?";
    text.remove_prefix(size);
  }
  return result + (text.empty() ? "'" : "…'");
}

}  // namespace ghtrack
