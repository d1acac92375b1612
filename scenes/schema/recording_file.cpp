#include "scenes/schema/recording_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "scenes/schema/diagnostic.hpp"
#include "scenes/schema/document.hpp"
#include "scenes/schema/number_text.hpp"
#include "scenes/schema/source_text.hpp"

namespace ghtrack::schema {
namespace {

constexpr std::size_t kMostRows = 1'000'000;
constexpr double kLongestTime = 1e10;  // [s], as RecordedPlace allows
constexpr double kFarthest = 1e6;      // [m], the same

constexpr std::array<std::string_view, 2> kTime{"t", "time"};
constexpr std::array<std::string_view, 1> kX{"x"};
constexpr std::array<std::string_view, 1> kY{"y"};
constexpr std::array<std::string_view, 4> kIds{"truth_id", "track_id", "id", "name"};

/// A cell of a line, without blanks and quotes around it.
struct Cell {
  std::string_view text;
  int column = 1;  // of the file, from 1
};

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::string_view text = line.substr(begin, end - begin);
    std::size_t skipped = 0;
    const auto is_margin = [](char c) { return c == ' ' || c == '\t' || c == '"' || c == '\r'; };
    while (!text.empty() && is_margin(text.front())) {
      text.remove_prefix(1);
      ++skipped;
    }
    while (!text.empty() && is_margin(text.back())) text.remove_suffix(1);
    cells.push_back({text, static_cast<int>(begin + skipped) + 1});
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

class RecordingTable {
 public:
  RecordingTable(std::string name, std::string_view text, const std::optional<std::string>& id)
      : name_(std::move(name)), text_(text), id_(id) {}

  std::vector<RecordedPlace> read() {
    std::vector<RecordedPlace> places;
    bool has_header = false;
    while (next_line()) {
      const std::vector<Cell> cells = cells_of(line_);
      if (cells.size() == 1 && cells[0].text.empty()) continue;
      if (!std::exchange(has_header, true)) {
        find_columns(cells);
        continue;
      }
      if (id_ && cell(cells, id_column_).text != *id_) continue;
      const RecordedPlace place{number(cells, t_, kLongestTime), number(cells, x_, kFarthest),
                                number(cells, y_, kFarthest)};
      if (!places.empty() && place.t - places.back().t < 1e-6) {
        fail(cell(cells, t_).column,
             fmt::format("the time {} is not later than that of the row before, {}{}",
                         shortest(place.t), shortest(places.back().t),
                         id_ ? "" : "; of several objects in a table, `id` chooses one"));
      }
      if (places.size() == kMostRows) fail(1, fmt::format("more than {} rows", kMostRows));
      places.push_back(place);
    }
    if (!has_header) throw SceneError({{.file = name_, .message = "the table is empty"}});
    if (places.empty()) {
      throw SceneError({{.file = name_,
                         .message = id_ ? fmt::format("no row has the id '{}'", *id_)
                                        : std::string("the table has no rows")}});
    }
    return places;
  }

 private:
  [[noreturn]] void fail(int column, std::string message) const {
    throw SceneError({{name_, number_, column, "", std::move(message)}});
  }

  bool next_line() {
    if (text_.empty()) return false;
    const std::size_t end = text_.find('\n');
    line_ = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    ++number_;
    return true;
  }

  std::optional<std::size_t> find(const std::vector<Cell>& header,
                                  std::span<const std::string_view> names) const {
    for (const std::string_view name : names) {
      for (std::size_t i = 0; i < header.size(); ++i) {
        if (header[i].text == name) return i;
      }
    }
    return std::nullopt;
  }

  std::size_t require(const std::vector<Cell>& header,
                      std::span<const std::string_view> names) const {
    if (const auto found = find(header, names)) return *found;
    std::string there;
    for (const Cell& one : header) there += (there.empty() ? "" : ", ") + std::string(one.text);
    fail(1, fmt::format("no column is called {}; columns: {}", fmt::join(names, " or "), there));
  }

  void find_columns(const std::vector<Cell>& header) {
    t_ = require(header, kTime);
    x_ = require(header, kX);
    y_ = require(header, kY);
    if (!id_) return;
    id_column_ = require(header, kIds);
  }

  Cell cell(const std::vector<Cell>& cells, std::size_t column) const {
    if (column < cells.size()) return cells[column];
    fail(1, fmt::format("has {} cells; the header has more", cells.size()));
  }

  double number(const std::vector<Cell>& cells, std::size_t column, double largest) const {
    const Cell at = cell(cells, column);
    double value = 0.0;
    if (parse_real(at.text, value) != std::errc() || !(value >= -largest && value <= largest)) {
      fail(at.column, fmt::format("must be a number from {} to {}; found '{}'", shortest(-largest),
                                  shortest(largest), at.text.substr(0, 40)));
    }
    return value;
  }

  std::string name_;
  std::string_view text_;  // what is left of it
  const std::optional<std::string>& id_;
  std::string_view line_;
  int number_ = 0;  // of that line
  std::size_t t_ = 0;
  std::size_t x_ = 0;
  std::size_t y_ = 0;
  std::size_t id_column_ = 0;
};

}  // namespace

void read_recordings(std::vector<Target>& targets, const std::filesystem::path& folder) {
  for (Target& target : targets) {
    auto* const recording = std::get_if<Recording>(&target.motion);
    if (recording == nullptr || recording->file.empty()) continue;
    const std::filesystem::path file = folder / recording->file;
    const std::string bytes = read_document_bytes(file);
    std::string_view text = bytes;
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    recording->places = RecordingTable(file.string(), text, recording->id).read();
    recording->file.clear();
    recording->id.reset();
  }
}

}  // namespace ghtrack::schema
