#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/record/ordered_rows.hpp"
#include "tools/record/text_file.hpp"
#include "tools/record/text_input.hpp"

namespace ghtrack {

/// A row of a file of boxes, and where it stands.
template <class Row>
struct FileRow {
  double time = 0.0;      // the number of its frame
  std::int64_t line = 0;  // from 1
  Row row;
};

/// Reads a file of boxes frame by frame. One in the order of frames is read in constant memory,
/// whatever its size; the rows of others, and of pipes, are held in memory.
template <class Row>
class FrameReader {
 public:
  /// Understands a line: absent if it has no row, or a wrong one, which is among the findings then.
  using Parse = std::function<std::optional<FileRow<Row>>(std::string_view line,
                                                          std::int64_t number, Findings& findings)>;

  /// Goes through the file once.
  /// @param visit  gets every row, in the order of the file
  /// @param pause  called between blocks; may throw to stop reading
  /// @throws InputError naming file, line, what was found and what is allowed
  template <class Visit>
  FrameReader(const std::string& path, Parse parse, Visit visit, std::function<void()> pause)
      : lines_(path, std::move(pause)),
        findings_(path),
        parse_(std::move(parse)),
        rows_([this](FileRow<Row>& row) { return read(row); },
              lines_.can_rewind() ? std::function<void()>([this] { lines_.rewind(); })
                                  : std::function<void()>()),
        frames_(rows_) {
    rows_.survey([&](const FileRow<Row>& row) { visit(row.row); });
    rows_.settle();
  }
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  bool in_order() const { return rows_.in_order(); }

  /// The rows of the next frame, in the order of the file; empty after the last.
  const std::vector<FileRow<Row>>& next() { return frames_.next(); }

  void rewind() { frames_.rewind(); }

  /// Refuses a frame in which an identity is there twice.
  /// @param ids  of the frame, each with its line
  /// @param frame  as the file calls it
  void refuse_twins(std::vector<std::pair<std::int64_t, std::int64_t>> ids, std::int64_t frame) {
    std::sort(ids.begin(), ids.end());
    for (std::size_t i = 1; i < ids.size(); ++i) {
      if (ids[i].first != ids[i - 1].first) continue;
      findings_.add(ids[i].second,
                    fmt::format("id {} is there twice in frame {}; the first is in line {}",
                                ids[i].first, frame, ids[i - 1].second));
    }
    findings_.throw_if_any();
  }

 private:
  bool read(FileRow<Row>& next) {
    while (!findings_.enough()) {
      const auto line = lines_.next();
      if (!line) break;
      auto row = parse_(*line, lines_.line_number(), findings_);
      if (!row) continue;
      next = std::move(*row);
      return true;
    }
    findings_.throw_if_any();
    return false;
  }

  TextInput lines_;
  Findings findings_;
  Parse parse_;
  OrderedRows<FileRow<Row>> rows_;
  Instants<FileRow<Row>> frames_;
};

}  // namespace ghtrack
