#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ghtrack {

/// Reads text line by line in constant memory, from a file, a pipe or standard input ("-"). Text is
/// UTF-8 without control characters other than tab and line ends; a byte order mark is passed over.
class TextInput {
 public:
  /// @param path   of a file or pipe, or "-"
  /// @param pause  called between blocks and when waiting is interrupted; may throw to stop reading
  /// @throws InputError if it cannot be opened, or is a folder, a device, or a named pipe to which
  /// nobody writes
  explicit TextInput(std::string path, std::function<void()> pause = {});

  /// Reads a text in memory.
  /// @param lines_before  added to the numbers of lines; −1: the first is not counted
  TextInput(std::string name, std::string text, std::int64_t lines_before = 0);
  ~TextInput();
  TextInput(const TextInput&) = delete;
  TextInput& operator=(const TextInput&) = delete;

  /// The next line without its end, valid until the next call; absent after the last.
  /// @throws InputError if it is longer than 64 KiB or no text
  std::optional<std::string_view> next();

  /// Of the line that next() gave, from 1.
  std::int64_t line_number() const { return line_number_; }

  /// Whether it can be read again: a regular file can, a pipe cannot.
  bool can_rewind() const { return can_rewind_; }

  /// Goes back to the start. Only if can_rewind().
  void rewind();

  /// As the user named it.
  const std::string& name() const { return name_; }

 private:
  bool fill();
  void find_line_end();
  void check(std::string_view line) const;
  void wait_for_bytes() const;
  [[noreturn]] void fail(const std::string& reason) const;

  std::string name_;
  std::function<void()> pause_;
  int descriptor_ = -1;
  bool can_rewind_ = false;
  bool is_pipe_ = false;
  std::string buffer_;
  std::size_t begin_ = 0;  // of what has not been given out
  std::size_t end_ = 0;    // of what has been read
  bool at_end_ = false;
  char line_end_ = '\n';
  bool is_plain_ = true;  // all bytes in the buffer are printable ASCII, tabs or line ends
  std::int64_t lines_before_ = 0;
  std::int64_t line_number_ = 0;
};

}  // namespace ghtrack
