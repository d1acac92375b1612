#include "tools/data/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "tools/data/clock.hpp"
#include "tools/data/formats.hpp"
#include "tools/data/place.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kSampleOfFile = 32;  // lines
constexpr std::size_t kSampleOfPipe = 2;   // so that live data are not held up

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t") == std::string_view::npos;
}

bool is_comment(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t");
  if (start == std::string_view::npos) return false;
  line.remove_prefix(start);
  return line.front() == '#' || line.front() == '%' || line.starts_with("//");
}

std::string_view without_comment_sign(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t#%/");
  return start == std::string_view::npos ? std::string_view{} : line.substr(start);
}

bool is_value(std::string_view cell, const Dialect& dialect) {
  return parse_number(cell, dialect) || parse_date_time(cell) ||
         parse_date_time(cell, DateOrder::kMonthFirst) || parse_time_of_day(cell) ||
         parse_place(cell);
}

std::int64_t characters(std::string_view text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; });
}

/// Joins a cell and the one after it, both of one line.
void join(std::vector<std::string_view>& cells, std::size_t at) {
  const char* const begin = cells[at].data();
  const std::string_view after = cells[at + 1];
  cells[at] = {begin, static_cast<std::size_t>(after.data() + after.size() - begin)};
  cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(at) + 1);
}

/// Where blanks separate, "Time (s)" and "x / mm" are one heading each.
void join_units(std::vector<std::string_view>& cells) {
  for (std::size_t i = 0; i + 1 < cells.size();) {
    const char first = cells[i + 1].empty() ? ' ' : cells[i + 1].front();
    if (first == '(' || first == '[') {
      join(cells, i);
    } else if (cells[i + 1] == "/" && i + 2 < cells.size()) {
      join(cells, i);
      join(cells, i);
    } else {
      ++i;
    }
  }
}

/// Where blanks separate, a date and the time after it are one value if they are one column.
void join_date_and_time(std::vector<std::string_view>& cells) {
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    if (!parse_date(cells[i]) || !parse_time_of_day(cells[i + 1])) continue;
    join(cells, i);
    return;
  }
}

std::vector<Heading> headings_in(const std::vector<std::string_view>& cells) {
  std::vector<Heading> headings;
  for (const std::string_view cell : cells) headings.push_back(parse_heading(cell));
  return headings;
}

/// What a row of headings tells.
struct Telling {
  bool time = false;
  bool place = false;  // or another value
};

Telling telling_of(const std::vector<Heading>& headings, const std::vector<ColumnChoice>& choices) {
  try {
    const ColumnMap map(headings, choices);
    const auto objects = SideBySide::find(headings);
    const bool has_times = objects && ColumnMap(objects->headings, {}).has(Role::kTime);
    return {.time = map.has(Role::kTime) || map.has(Role::kFrame) || has_times,
            .place = map.has_plane() || map.has_degrees() || map.has_polar() || map.has(Role::kZ) ||
                     objects};
  } catch (const ColumnError&) {  // a column that is there twice: not for this to say
    return {};
  }
}

/// Where one name heads several columns, as X of a rotation and of a position, the rows above tell
/// them apart, the nearest first; a cell there may stand for those after it, too.
std::vector<Heading> headings_below(const std::vector<std::vector<std::string>>& above,
                                    const std::vector<std::string_view>& cells) {
  std::vector<std::string> names(cells.begin(), cells.end());
  for (auto row = above.rbegin(); row != above.rend(); ++row) {
    const std::vector<std::string> below = names;
    std::string group;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (i < row->size() && !(*row)[i].empty()) group = (*row)[i];
      const bool repeats = std::count(below.begin(), below.end(), below[i]) > 1;
      if (repeats && !group.empty()) names[i] = fmt::format("{} {}", group, below[i]);
    }
  }
  std::vector<Heading> headings;
  for (const std::string& name : names) headings.push_back(parse_heading(name));
  return headings;
}

constexpr std::size_t kMostLines = 20;  // of a cell in quotes

/// Whether a row ends inside a cell in quotes; absent if there is text behind a closing quote, so
/// that the quotes are none that could be relied on.
std::optional<bool> ends_in_quotes(std::string_view row) {
  constexpr std::string_view kSeparators = ",;\t|";
  bool at_start = true;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] != '"' || !at_start) {
      at_start = kSeparators.find(row[i]) != kSeparators.npos || (at_start && row[i] == ' ');
      continue;
    }
    for (++i; i < row.size(); ++i) {  // to the closing quote
      if (row[i] != '"') continue;
      if (i + 1 == row.size() || row[i + 1] != '"') break;
      ++i;
    }
    if (i >= row.size()) return true;
    const std::size_t after = row.find_first_not_of(' ', i + 1);
    const bool is_blank_next = after != row.npos && after > i + 1;
    if (after != row.npos && !is_blank_next && kSeparators.find(row[after]) == kSeparators.npos) {
      return std::nullopt;
    }
    at_start = is_blank_next;
  }
  return false;
}

TextInput open_input(const std::string& path, const std::function<void()>& pause) {
  if (auto text = points_as_csv(path)) return TextInput(path, *std::move(text), -1);
  return TextInput(path, pause);
}

}  // namespace

Table::Table(const std::string& path, const ReadOptions& options)
    : options_(options),
      input_(open_input(path, options.pause)),
      findings_(input_.name()),
      columns_({}, {}) {
  try {
    take_sample();
    std::vector<ColumnChoice> choices = parse_column_choices(options_.columns);
    if (!options_.time_column.empty()) {
      for (const ColumnChoice& choice : choices) {
        if (choice.role != Role::kTime) continue;
        throw ColumnError(fmt::format("the times are {} by --columns and {} by --t-column",
                                      in_quotes(choice.column), in_quotes(options_.time_column)));
      }
      choices.push_back({Role::kTime, options_.time_column});
    }
    take_units_of(choices);
    name_index();
    part_objects(choices);
    columns_ = ColumnMap(headings_, choices);
    if (side_by_side_) {
      columns_.add(Role::kIdentity, headings_.size() - 1);
      columns_.add(Role::kClass, headings_.size() - 1);
    }
    find_first_values();
  } catch (const ColumnError& error) {
    findings_.add(sample_.empty() ? 0 : sample_.front().number, error.what());
    findings_.throw_if_any();
  }
}

/// `t=timestamp[us]` says the unit of a column that does not.
void Table::take_units_of(std::vector<ColumnChoice>& choices) {
  for (ColumnChoice& choice : choices) {
    if (column(choice.column)) continue;
    const Heading wanted = parse_heading(choice.column);
    if (!wanted.unit || !choice.column.ends_with(']')) continue;
    choice.column.erase(choice.column.rfind('['));
    for (std::size_t i = 0; i < headings_.size(); ++i) {
      if (headings_[i].text == choice.column || headings_[i].base == wanted.base ||
          std::to_string(i + 1) == choice.column) {
        headings_[i].unit = wanted.unit;
        break;
      }
    }
  }
}

void Table::take_sample() {
  const std::size_t most = input_.can_rewind() ? kSampleOfFile : kSampleOfPipe;
  std::string last_comment;
  while (sample_.size() < most) {
    const auto line = read_line();
    if (!line) break;
    if (is_comment(*line)) {
      if (sample_.empty()) last_comment = *line;
    } else if (!is_blank(*line) || !sample_.empty()) {
      sample_.push_back({std::string(*line), line_read_});
      sample_end_ = input_.line_number() - std::ssize(ahead_);
    }
  }
  std::vector<std::string> lines;
  for (const Line& line : sample_) lines.push_back(line.text);
  dialect_ = recognise_dialect(lines);
  find_header(last_comment);
  width_ = headings_.size();
  at_ = first_row_;
}

/// Where the first column has no name and no other tells the time, it is the index of the rows: a
/// time, or the number of an image.
void Table::name_index() {
  if (!has_header_ || first_row_ >= sample_.size() || !headings_.front().text.empty()) return;
  for (const Role role : {Role::kTime, Role::kFrame, Role::kDate}) {
    if (ColumnMap(headings_, {}).has(role)) return;
  }
  split_row(sample_[first_row_].text);
  const bool counts = cells_.front().find_first_not_of("0123456789") == std::string_view::npos;
  headings_.front() = parse_heading(counts ? "frame" : "time");
  headings_.front().text = "column 1";
}

/// Makes rows of the objects that stand side by side, unless one of them was asked for.
void Table::part_objects(std::vector<ColumnChoice>& choices) {
  for (const ColumnChoice& choice : choices) {
    for (const Role role : {Role::kX, Role::kY, Role::kZ, Role::kLatitude, Role::kLongitude,
                            Role::kPlace, Role::kRange, Role::kIdentity}) {
      if (choice.role == role) return;
    }
  }
  const ColumnMap map(headings_, choices);
  if (map.has_plane() || map.has_degrees() || map.has_polar() || map.has(Role::kZ)) return;
  std::optional<SideBySide> objects = SideBySide::find(headings_);
  if (!objects) return;
  for (ColumnChoice& choice : choices) {  // a number counts the columns of the file
    const auto number = parse_whole(choice.column);
    if (column(choice.column) || !number || *number < 1 || *number > std::ssize(headings_))
      continue;
    choice.column = headings_[static_cast<std::size_t>(*number - 1)].text;
  }
  headings_ = objects->headings;
  side_by_side_ = std::move(objects);
}

void Table::find_first_values() {
  first_values_.resize(headings_.size());
  for (std::size_t row = first_row_; row < sample_.size(); ++row) {
    split_row(sample_[row].text);
    show_first_object();
    if (row == first_row_) first_cells_.assign(cells_.begin(), cells_.end());
    for (std::size_t i = 0; i < std::min(cells_.size(), headings_.size()); ++i) {
      if (first_values_[i].empty() && is_value(cells_[i], dialect_)) {
        first_values_[i] = cells_[i];
      }
    }
  }
}

void Table::find_header(const std::string& last_comment) {
  if (sample_.empty()) return;
  split_cells(sample_.front().text, dialect_.separator, cells_, owned_);
  if (dialect_.separator == ' ') join_units(cells_);
  has_header_ = !starts_with_value();
  if (has_header_) {
    headings_ = headings_in(cells_);
    first_row_ = 1;
    take_title_rows();
    header_ = sample_[first_row_ - 1].text;
    if (take_index_name()) ++first_row_;
    while (first_row_ < sample_.size() && repeats_header(sample_[first_row_].text)) ++first_row_;
    if (take_units_row()) ++first_row_;
    if (has_row_names()) headings_.insert(headings_.begin(), Heading{});
    return;
  }
  const std::size_t count = cells_.size();
  split_cells(without_comment_sign(last_comment), dialect_.separator, cells_, owned_);
  if (count > 1 && cells_.size() == count) {
    headings_ = headings_in(cells_);
    const ColumnMap map(headings_, {});
    has_header_ = map.has(Role::kTime) || map.has(Role::kFrame) || map.has(Role::kX);
    if (has_header_) return;
    headings_.clear();
  }
  if (count == 1) {
    headings_.push_back(parse_heading("z"));
    return;
  }
  for (std::size_t i = 1; i <= count; ++i) {
    headings_.push_back({.text = std::to_string(i), .base = ""});
  }
}

bool Table::starts_with_value() const {
  return is_value(cells_.front(), dialect_) ||
         (cells_.size() > 1 && is_missing(cells_.front()) && is_value(cells_[1], dialect_));
}

/// Where the first row says nothing of the columns, a row of headings below it may: above it are
/// titles, as the names of objects in a program for videos, or the rate of a motion capture alone.
/// Where several rows of headings have their own names in the first column, as in tables of pandas
/// and DeepLabCut, that column is the index.
void Table::take_title_rows() {
  std::vector<ColumnChoice> choices = parse_column_choices(options_.columns);
  std::erase_if(choices, [](const ColumnChoice& choice) { return parse_whole(choice.column); });
  const Telling first = telling_of(headings_, choices);
  if (first.time && first.place) return;
  std::vector<std::vector<std::string>> above;
  for (std::size_t row = 0; row < sample_.size(); ++row) {
    split_cells(sample_[row].text, dialect_.separator, cells_, owned_);
    if (row > 0 && cells_.size() > 1 && starts_with_value()) return;
    std::vector<Heading> below = headings_below(above, cells_);
    const bool is_index = row > 0 && cells_.size() > 1 && cells_.size() == above.back().size();
    const Telling told = telling_of(below, choices);
    if (told.place && (told.time || is_index)) {
      if (!told.time) below.front() = Heading{};
      headings_ = std::move(below);
      first_row_ = row + 1;
      return;
    }
    above.emplace_back(cells_.begin(), cells_.end());
  }
}

/// Whether the row below the header has nothing but the name of the first column, as pandas writes
/// it. Takes it.
bool Table::take_index_name() {
  if (first_row_ >= sample_.size() || !headings_.front().text.empty()) return false;
  split_cells(sample_[first_row_].text, dialect_.separator, cells_, owned_);
  const bool is_alone = cells_.size() == headings_.size() && cells_.size() > 1 &&
                        !cells_.front().empty() && !starts_with_value() &&
                        std::all_of(cells_.begin() + 1, cells_.end(),
                                    [](std::string_view cell) { return cell.empty(); });
  if (is_alone) headings_.front() = parse_heading(cells_.front());
  return is_alone;
}

/// Whether a row below the header is one again: what was measured is named where it is.
bool Table::repeats_header(const std::string& line) {
  std::vector<std::string_view> cells;
  split_cells(line, dialect_.separator, cells, owned_);
  if (cells.size() != headings_.size()) return false;
  try {
    const ColumnMap map(headings_, {});
    const ColumnMap repeated(headings_in(cells), {});
    const auto is_same = [&](Role role) {
      return repeated.has(role) && repeated.find(role) == map.find(role);
    };
    return (is_same(Role::kX) && is_same(Role::kY)) || (is_same(Role::kTime) && is_same(Role::kZ));
  } catch (const ColumnError&) {
    return false;
  }
}

/// Whether each row begins with a name in quotes that the header has no heading for, as R writes
/// tables.
bool Table::has_row_names() {
  std::vector<std::string_view> cells;
  const auto is_named = [&](const Line& line) {
    split_cells(line.text, dialect_.separator, cells, owned_);
    return line.text.starts_with('"') && cells.size() == headings_.size() + 1 &&
           !cells.back().empty();
  };
  const auto rows = std::span(sample_).subspan(first_row_);
  return !rows.empty() && sample_.front().text.starts_with('"') &&
         std::all_of(rows.begin(), rows.end(), is_named);
}

/// Takes the row below the header for the units of the columns if it holds no numbers and, where
/// times and places are, nothing but units; "m/s" elsewhere is no matter.
bool Table::take_units_row() {
  if (first_row_ >= sample_.size()) return false;
  std::vector<std::string_view> units;
  split_cells(sample_[first_row_].text, dialect_.separator, units, owned_);
  const auto is_some_value = [&](std::string_view cell) { return is_value(cell, dialect_); };
  if (units.size() != headings_.size() || std::any_of(units.begin(), units.end(), is_some_value)) {
    return false;
  }
  std::vector<Heading> with_units = headings_;
  const ColumnMap map(headings_, {});
  const auto is_place_or_time = [&](std::size_t column) {
    const auto belonging = belonging_of(headings_[column]);
    return map.has_role(column) || (belonging && belonging->quantity.size() == 1);
  };
  bool any = false;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (is_missing(units[i])) continue;
    const bool bracketed = units[i].front() == '(' || units[i].front() == '[';
    const Heading heading =
        parse_heading("x " + (bracketed ? std::string(units[i]) : fmt::format("({})", units[i])));
    if (!heading.unit && !bracketed && is_place_or_time(i)) return false;
    with_units[i].unit = heading.unit;
    any = any || heading.unit.has_value();
  }
  if (any) headings_ = std::move(with_units);
  return any;
}

std::optional<std::size_t> Table::column(std::string_view name) const {
  const auto found = std::find_if(headings_.begin(), headings_.end(),
                                  [&](const Heading& heading) { return heading.text == name; });
  if (found == headings_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - headings_.begin());
}

std::optional<std::size_t> Table::column_with_base(std::string_view name) const {
  if (const auto exact = column(name)) return exact;
  const auto found = std::find_if(headings_.begin(), headings_.end(),
                                  [&](const Heading& heading) { return heading.base == name; });
  if (found == headings_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - headings_.begin());
}

std::optional<std::size_t> Table::column_with_unit(std::string_view name) const {
  const auto found = column_with_base(name);
  const bool is_meant = found && (headings_[*found].unit || headings_[*found].text == name);
  return is_meant ? found : std::nullopt;
}

std::size_t Table::required(Role role) {
  if (const auto found = columns_.find(role)) return *found;
  std::string known;
  for (const Heading& heading : headings_) {
    if (known.size() < 200) known += (known.empty() ? "" : ", ") + in_quotes(heading.text);
  }
  const std::int64_t line = sample_.empty() ? 1 : sample_.front().number;
  if (!has_header_ && !headings_.empty()) {
    findings_.add(line, fmt::format("there is no header row; name the columns by their numbers, "
                                    "such as --columns t=1,x=2,y=3 ({} is missing)",
                                    to_string(role)));
    return 0;
  }
  findings_.add(line,
                fmt::format("column '{}' is missing; the header row has {}; --columns "
                            "{}=NAME says which one it is{}",
                            to_string(role), known.empty() ? "nothing" : known, to_string(role),
                            role == Role::kTime ? ", 't=NAME[ms]' in which unit" : ""));
  return 0;
}

std::string_view Table::first_cell(std::size_t column) const {
  return column < first_cells_.size() ? std::string_view(first_cells_[column]) : std::string_view{};
}

bool Table::any_first(std::size_t column, const std::function<bool(std::string_view)>& is_so) {
  for (std::size_t row = first_row_; row < sample_.size(); ++row) {
    split_row(sample_[row].text);
    if (cells_.size() != width_) continue;
    show_first_object();
    if (is_so(cells_[column])) return true;
  }
  return false;
}

bool Table::begins_with_numbers(std::size_t column) {
  return !any_first(column, [](std::string_view cell) {
    return cell.find_first_not_of("+-.0123456789") != std::string_view::npos;
  });
}

bool Table::shows(std::size_t column, char character) {
  return any_first(column, [&](std::string_view cell) {
    return cell.find(character) != std::string_view::npos;
  });
}

std::string_view Table::first_value(std::size_t column) const {
  const bool found = column < first_values_.size() && !first_values_[column].empty();
  return found ? std::string_view(first_values_[column]) : first_cell(column);
}

/// The next line of the file, with those after it if a cell in quotes goes on there.
std::optional<std::string_view> Table::read_line() {
  if (ahead_.empty()) {
    const auto line = input_.next();
    line_read_ = input_.line_number();
    if (!line || line->find('"') == line->npos || ends_in_quotes(*line) != true) return line;
    ahead_.push_back({std::string(*line), line_read_});
  }
  joined_ = ahead_.front().text;
  line_read_ = ahead_.front().number;
  std::size_t lines = 1;
  for (; ends_in_quotes(joined_) == true && lines < kMostLines; ++lines) {
    if (lines == ahead_.size()) {
      const auto more = input_.next();
      if (!more) break;
      ahead_.push_back({std::string(*more), input_.line_number()});
    }
    joined_ += ' ';
    joined_ += ahead_[lines].text;
  }
  if (ends_in_quotes(joined_) != false) {  // it never ends: the line stands for itself
    joined_ = ahead_.front().text;
    lines = 1;
  }
  ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(lines));
  return joined_;
}

std::optional<std::string_view> Table::next_line() {
  if (at_ < sample_.size()) {
    line_number_ = sample_[at_].number;
    return sample_[at_++].text;
  }
  const auto line = read_line();
  line_number_ = line_read_;
  return line;
}

void Table::split_row(std::string_view line) {
  split_cells(line, dialect_.separator, cells_, owned_);
  while (cells_.size() > width_ && cells_.back().empty()) cells_.pop_back();
  while (cells_.size() < width_ && !side_by_side_ && headings_[cells_.size()].text.empty()) {
    cells_.emplace_back();  // a column without a name needs no cells
  }
  if (dialect_.separator == ' ' && cells_.size() == width_ + 1) join_date_and_time(cells_);
}

/// Makes the cells of a row that has been split those of its first object.
void Table::show_first_object() {
  if (!side_by_side_ || cells_.size() != width_) return;
  fields_.swap(cells_);
  side_by_side_->arrange(fields_, side_by_side_->objects.front(), cells_);
}

/// Whether the object has nothing in the row, not even a time, since it has times of its own.
bool Table::is_object_absent() const {
  if (!side_by_side_) return false;
  const auto time = columns_.find(Role::kTime);
  return time && *time >= side_by_side_->shared && side_by_side_->is_absent(cells_);
}

/// Goes to the next object of the row, if there is one.
bool Table::next_object() {
  while (objects_left_ > 0) {
    const auto& objects = side_by_side_->objects;
    side_by_side_->arrange(fields_, objects[objects.size() - objects_left_], cells_);
    --objects_left_;
    if (!is_object_absent()) return true;
  }
  return false;
}

bool Table::next() {
  if (next_object()) return true;
  while (options_.skip_bad_rows || !findings_.enough()) {
    const auto line = next_line();
    if (!line) return false;
    if (line->empty() ? width_ != 1 : (is_blank(*line) || is_comment(*line))) continue;
    line_ = *line;
    if (has_header_ && line_ == header_) continue;  // files that were put together have it again
    split_row(line_);
    if (cells_.size() == width_) {
      show_first_object();
      objects_left_ = side_by_side_ ? side_by_side_->objects.size() - 1 : 0;
      if (!is_object_absent() || next_object()) return true;
      continue;
    }
    const bool is_open = line_.find('"') != line_.npos && ends_in_quotes(line_) != false;
    reject(fmt::format("this row has {} fields; the {} row has {}{}", cells_.size(),
                       has_header_ ? "header" : "first", width_,
                       is_open ? "; a cell in quotes does not end, or has text behind it" : ""));
  }
  return false;
}

std::optional<double> Table::number_or_missing(std::size_t column) {
  const auto value = number(column);
  if (!value && !is_missing(cells_[column])) reject_cell(column, "a finite number");
  return value;
}

void Table::reject_cell(std::size_t column, const std::string& expectation) {
  const std::string_view cell = cells_[column];
  std::int64_t at = 0;
  if (cell.data() >= line_.data() && cell.data() <= line_.data() + line_.size()) {
    at = 1 + characters({line_.data(), static_cast<std::size_t>(cell.data() - line_.data())});
  }
  reject_at(at, fmt::format("{} in column {} is not {}", in_quotes(cell),
                            in_quotes(headings_[column].text), expectation));
}

void Table::reject_at(std::int64_t character, const std::string& message) {
  if (!is_rejected()) ++rejected_;
  rejected_line_ = line_number_;
  findings_.add(line_number_, message, character);
}

void Table::throw_findings() const {
  if (!options_.skip_bad_rows) findings_.throw_if_any();
}

void Table::rewind() {
  input_.rewind();
  while (input_.line_number() < sample_end_) input_.next();
  ahead_.clear();
  at_ = first_row_;
  objects_left_ = 0;
  findings_ = Findings(input_.name());
  rejected_ = 0;
  rejected_line_ = -1;
}

}  // namespace ghtrack
