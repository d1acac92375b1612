#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/data/dialect.hpp"
#include "tools/data/header.hpp"
#include "tools/data/side_by_side.hpp"
#include "tools/record/text_file.hpp"
#include "tools/record/text_input.hpp"

namespace ghtrack {

/// How somebody else's file is to be read.
struct ReadOptions {
  std::string columns = {};                         // t=NAME,x=NAME,…; empty: by their names
  std::string time_column = {};                     // the same of t, with any name
  std::optional<double> frame_rate = std::nullopt;  // of a column of frame numbers [Hz]
  bool skip_bad_rows = false;                       // leave them out instead of refusing the file
  std::function<void()> pause = {};                 // called between blocks; may throw
};

/// A table of text, row by row in constant memory: CSV and its kin, with a header row, a header in
/// the last comment line, or none. Empty lines and those that start with #, % or // are passed
/// over. A cell in quotes may go on in the next lines; its line breaks are read as blanks. Where
/// several objects stand side by side, each row of the file is a row for each of them.
///
/// What is wrong with rows is gathered: throw_findings() refuses the file with all of it, unless
/// bad rows are to be left out.
class Table {
 public:
  /// @param path  of a file or pipe, or "-"; also of a format that points_as_csv() turns into one
  /// @throws InputError if it cannot be read, or chosen columns are not there
  explicit Table(const std::string& path, const ReadOptions& options = {});

  const std::string& name() const { return input_.name(); }
  const Dialect& dialect() const { return dialect_; }

  /// One per column. Without a header row they are called "1", "2", …, and a single one "z".
  const std::vector<Heading>& headings() const { return headings_; }
  bool has_header() const { return has_header_; }
  const ColumnMap& columns() const { return columns_; }

  /// Where several objects stand side by side.
  const std::optional<SideBySide>& side_by_side() const { return side_by_side_; }

  /// The column of exactly this name.
  std::optional<std::size_t> column(std::string_view name) const;

  /// The same, or of this name whatever its unit and the size of its letters.
  std::optional<std::size_t> column_with_base(std::string_view name) const;

  /// The same, or of this name before a unit, as "dt (ms)".
  std::optional<std::size_t> column_with_unit(std::string_view name) const;

  /// The column of a role that must be there. A missing one is a finding.
  std::size_t required(Role role);

  /// The first row of data as text, empty if there is none.
  std::string_view first_cell(std::size_t column) const;

  /// Whether something is so of one of the cells of a column in the first rows.
  bool any_first(std::size_t column, const std::function<bool(std::string_view)>& is_so);

  /// Whether the first rows have nothing but digits, signs and points in a column.
  bool begins_with_numbers(std::size_t column);

  /// Whether the first rows have a character in a column.
  bool shows(std::size_t column, char character);

  /// The first number, date or time of a column in the first rows; else its first cell.
  std::string_view first_value(std::size_t column) const;

  /// Goes to the next row that has as many cells as the header; false after the last.
  bool next();

  std::int64_t line() const { return line_number_; }
  std::string_view text() const { return line_; }  // of the row in the file
  std::string_view cell(std::size_t column) const { return cells_[column]; }

  /// The finite number in a cell; absent if it is anything else.
  std::optional<double> number(std::size_t column) const {
    return parse_number(cells_[column], dialect_);
  }

  /// The same, or absent where the cell says that there is none; anything else is noted.
  std::optional<double> number_or_missing(std::size_t column);

  /// Notes that the row is not what it should be.
  void reject(const std::string& message) { reject_at(0, message); }
  void reject_cell(std::size_t column, const std::string& expectation);

  /// Whether something is wrong with the present row.
  bool is_rejected() const { return rejected_line_ == line_number_; }

  /// How many rows have been left out, and what was wrong with the first of them.
  std::int64_t rows_left_out() const { return rejected_; }
  const std::vector<std::string>& remarks() const { return findings_.lines(); }

  /// @throws InputError if a required column was missing
  void throw_missing_columns() const { findings_.throw_if_any(); }

  /// @throws InputError with all findings, unless bad rows are left out
  void throw_findings() const;

  bool can_rewind() const { return input_.can_rewind(); }

  /// Goes back to the first row and forgets the findings.
  void rewind();

 private:
  struct Line {
    std::string text;
    std::int64_t number;
  };

  void take_sample();
  void take_units_of(std::vector<ColumnChoice>& choices);
  void find_header(const std::string& last_comment);
  void find_first_values();
  bool starts_with_value() const;
  void take_title_rows();
  bool take_index_name();
  bool take_units_row();
  void name_index();
  void part_objects(std::vector<ColumnChoice>& choices);
  bool repeats_header(const std::string& line);
  bool has_row_names();
  std::optional<std::string_view> read_line();
  std::optional<std::string_view> next_line();
  void split_row(std::string_view line);
  bool is_object_absent() const;
  bool next_object();
  void show_first_object();
  void reject_at(std::int64_t character, const std::string& message);

  ReadOptions options_;
  TextInput input_;
  Findings findings_;
  std::int64_t rejected_ = 0;        // rows
  std::int64_t rejected_line_ = -1;  // the last of them
  Dialect dialect_;
  std::vector<Heading> headings_;
  ColumnMap columns_;
  bool has_header_ = false;
  std::string header_;           // the row itself
  std::vector<Line> sample_;     // the first lines that are no comments
  std::size_t first_row_ = 0;    // where in the sample the data begin
  std::size_t at_ = 0;           // in the sample
  std::int64_t sample_end_ = 0;  // line of the file in which it ends
  std::deque<Line> ahead_;       // lines in which the end of a quoted cell was looked for
  std::string joined_;           // a row of several lines
  std::int64_t line_read_ = 0;   // where the line that was read last begins
  std::string_view line_;
  std::int64_t line_number_ = 0;
  std::vector<std::string_view> cells_;
  std::optional<SideBySide> side_by_side_;
  std::size_t width_ = 0;                 // cells in a row of the file
  std::size_t objects_left_ = 0;          // of those side by side in the row
  std::vector<std::string_view> fields_;  // of all objects
  std::vector<std::string> owned_;
  std::vector<std::string> first_cells_, first_values_;
};

}  // namespace ghtrack
