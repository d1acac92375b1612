#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ghtrack::cli {

/// Reads a table of numbers row by row in constant memory: a CSV file with a header row, or bare
/// numbers, one a line, which make a column `z`. Blank lines are passed over.
class NumberTable {
 public:
  /// @param file  a path, or - for standard input
  /// @throws InputError if it cannot be read
  explicit NumberTable(const std::string& file);
  ~NumberTable();
  NumberTable(const NumberTable&) = delete;
  NumberTable& operator=(const NumberTable&) = delete;

  /// Index of a column, if there is one.
  std::optional<std::size_t> column(std::string_view name) const;
  const std::vector<std::string>& columns() const { return columns_; }

  /// Goes to the next row. @returns false at the end
  /// @throws InputError if it has too many or too few cells
  bool next();

  /// The number in a cell of the row; nothing if the cell is empty. May be NaN or infinite.
  /// @throws InputError if it is no number
  std::optional<double> cell(std::size_t column) const;

  /// Number of the row's line in the file.
  long line() const { return line_number_; }
  /// "file:line", for messages.
  std::string place(long line) const;
  [[noreturn]] void fail(const std::string& message) const;

 private:
  bool read_line();
  void split();

  std::string file_;
  int descriptor_ = -1;
  std::string buffer_;
  std::size_t begin_ = 0;  // of the unread part of the buffer
  bool at_end_ = false;
  bool header_is_data_ = false;  // bare numbers: the first line is the first row
  long line_number_ = 0;
  std::string_view line_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> cells_;
};

}  // namespace ghtrack::cli
