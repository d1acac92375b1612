#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack {

inline constexpr std::size_t kLongestLine = std::size_t{64} << 10;  // that is read [bytes]

/// What is wrong with a text file, gathered so that the user sees all of it at once.
class Findings {
 public:
  explicit Findings(std::string file) : file_(std::move(file)) {}

  /// @param line    from 1; 0 if it is about the file as a whole
  /// @param column  in characters, from 1; 0 if it is about the line as a whole
  void add(std::int64_t line, std::string_view message, std::int64_t column = 0);

  /// Reading on would only repeat itself.
  bool enough() const { return lines_.size() >= kMost; }

  const std::vector<std::string>& lines() const { return lines_; }

  /// @throws InputError with one line per finding, if there is any
  void throw_if_any() const;

 private:
  static constexpr std::size_t kMost = 10;

  std::string file_;
  std::vector<std::string> lines_;
};

/// What a file is called in messages: its path, or "standard input" for `-`.
std::string input_name(const std::filesystem::path& path);

/// Reads a regular file as text: UTF-8 without control characters other than tab and line ends, a
/// byte order mark removed. Pipes and devices are refused without waiting for them, except those
/// that this process has open: `-` is standard input, and /dev/fd/N what a shell puts there.
/// @throws InputError if it cannot be read, is longer than 256 MiB, has a line of more than 64 KiB
/// or is no text
std::string read_text_file(const std::filesystem::path& path);

/// Goes through the lines of a text; they end in LF or CR LF.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  /// The next line without its end; absent after the last one.
  std::optional<std::string_view> next();

  std::int64_t number() const { return number_; }  // of the line that next() gave, from 1

 private:
  std::string_view rest_;
  std::int64_t number_ = 0;
};

/// Splits at commas and removes blanks and tabs around the fields. Where a line has no comma, its
/// fields are separated by tabs. A field in double quotes may hold commas; doubled quotes in it
/// stand for one. `fields` refer to the line or, for quoted fields with doubled quotes, to `owned`.
void split_fields(std::string_view line, std::vector<std::string_view>& fields,
                  std::vector<std::string>& owned);

/// Whether it is UTF-8 without overlong forms and surrogates, and without control characters other
/// than tab and line ends.
bool is_text(std::string_view text);

/// The finite number that makes up the whole text; absent if it is anything else.
/// @param point  what stands before the decimals: '.' or ','
std::optional<double> parse_number(std::string_view text, char point = '.');

/// The numbers of a line of nothing but commas, blanks before numbers, and numbers of few digits,
/// as almost every line of a table of numbers is: what split_fields() and parse_number() would make
/// of it, for a fraction of their work.
/// @returns how many there are; 0 if the line is any other, or has more than there is room for
std::size_t plain_numbers(std::string_view line, std::span<double> numbers);

/// The whole number, in the range of an identity, that makes up the text; 3 and 3.0 are the same.
std::optional<std::int64_t> parse_whole(std::string_view text);
std::optional<std::int64_t> as_whole(double value);

/// Appends a number with two decimals, those of the nearest such number (as `{:.2f}` does).
void append_hundredths(std::string& text, double value);

/// The text in quotes, safe for a terminal and short enough for a message.
std::string in_quotes(std::string_view text);

}  // namespace ghtrack
