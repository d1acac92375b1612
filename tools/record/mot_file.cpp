#include "tools/record/mot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string_view>
#include <tuple>
#include <utility>

#include "tools/record/kitti_file.hpp"
#include "tools/record/text_file.hpp"
#include "tools/record/text_input.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kFewestFields = 6;
constexpr std::size_t kMostFields = 10;
constexpr std::size_t kTruthFields = 9;  // of ground truth with categories

struct NumberedRow {
  MotRow row;
  std::int64_t line = 0;
};

/// Turns the fields of a line into a row, or reports what is wrong with it.
std::optional<MotRow> parse_row(const std::vector<std::string_view>& fields, MotKind kind,
                                std::optional<std::int32_t> last_frame, std::int64_t line,
                                Findings& findings) {
  if (fields.size() < kFewestFields || fields.size() > kMostFields) {
    findings.add(line, fmt::format("{} fields; a row has frame,id,left,top,width,height and up to "
                                   "{} fields in all",
                                   fields.size(), kMostFields));
    return std::nullopt;
  }
  constexpr std::array<std::string_view, kMostFields> kNames = {
      "frame", "id", "left", "top", "width", "height", "conf", "x", "y", "z"};
  std::array<double, kMostFields> values{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<double> value = parse_number(fields[i]);
    if (!value) {
      findings.add(line, fmt::format("{} in field {} ({}) is not a finite number",
                                     in_quotes(fields[i]), i + 1, kNames[i]));
      return std::nullopt;
    }
    values[i] = *value;
  }
  const std::optional<std::int64_t> frame = parse_whole(fields[0]);
  const std::int32_t last = last_frame.value_or(std::numeric_limits<std::int32_t>::max());
  if (!frame || *frame < 1 || *frame > last) {
    findings.add(line, fmt::format("frame {} is not a whole number from 1 to {}",
                                   in_quotes(fields[0]), last));
    return std::nullopt;
  }
  const std::optional<std::int64_t> id = parse_whole(fields[1]);
  if (!id) {
    findings.add(line, fmt::format("id {} is not a whole number", in_quotes(fields[1])));
    return std::nullopt;
  }
  if (!(values[4] > 0.0) || !(values[5] > 0.0)) {
    findings.add(line, fmt::format("width {} and height {} must be above 0", in_quotes(fields[4]),
                                   in_quotes(fields[5])));
    return std::nullopt;
  }
  MotRow row{.frame = static_cast<std::int32_t>(*frame),
             .id = *id,
             .left = values[2],
             .top = values[3],
             .width = values[4],
             .height = values[5]};
  if (fields.size() > kFewestFields) row.confidence = values[6];
  if (kind != MotKind::kDetections && fields.size() == kTruthFields) {
    row.category = static_cast<std::int32_t>(std::clamp(values[7], -1.0, 1e6));
  }
  return row;
}

/// "frame,id,bb_left,bb_top,…", as some tools put above the rows.
bool is_header(const std::vector<std::string_view>& fields) {
  const auto says = [&](std::size_t i, std::string_view word) {
    return fields[i].find(word) != std::string_view::npos;
  };
  return fields.size() >= kFewestFields && says(0, "rame") && (says(2, "eft") || says(2, "x"));
}

void check_ids(const std::vector<NumberedRow>& rows, MotKind kind, Findings& findings) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (kind != MotKind::kTruth || rows[i].row.confidence != 0.0) order.push_back(i);
  }
  const auto key = [&](std::size_t i) { return std::tuple(rows[i].row.frame, rows[i].row.id, i); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const NumberedRow& first = rows[order[i - 1]];
    const NumberedRow& second = rows[order[i]];
    if (first.row.frame != second.row.frame || first.row.id != second.row.id) continue;
    findings.add(second.line,
                 fmt::format("id {} is there twice in frame {}; the first is in line {}",
                             second.row.id, second.row.frame, first.line));
  }
}

}  // namespace

std::vector<MotRow> read_mot_file(const std::filesystem::path& path, MotKind kind,
                                  std::optional<std::int32_t> last_frame) {
  if (looks_like_kitti_file(path)) {
    std::vector<MotRow> boxes;
    for (const KittiRow& row : read_kitti_file(path, kind).rows) boxes.push_back(row.box);
    return boxes;
  }
  TextInput lines(path.string());
  Findings findings(path.string());
  std::vector<NumberedRow> rows;
  std::vector<std::string_view> fields;
  std::vector<std::string> owned;
  bool is_first = true;
  for (auto line = lines.next(); line && !findings.enough(); line = lines.next()) {
    if (line->find_first_not_of(" \t") == std::string_view::npos) continue;
    split_fields(*line, fields, owned);
    if (std::exchange(is_first, false) && is_header(fields)) continue;
    const auto row = parse_row(fields, kind, last_frame, lines.line_number(), findings);
    if (row) rows.push_back({*row, lines.line_number()});
  }
  findings.throw_if_any();
  std::stable_sort(rows.begin(), rows.end(), [](const NumberedRow& a, const NumberedRow& b) {
    return a.row.frame < b.row.frame;
  });
  if (kind != MotKind::kDetections) check_ids(rows, kind, findings);
  findings.throw_if_any();

  std::vector<MotRow> result;
  result.reserve(rows.size());
  for (const NumberedRow& numbered : rows) result.push_back(numbered.row);
  return result;
}

bool looks_like_mot_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  while (line.find_first_not_of(" \t\r") == std::string::npos) {
    if (!std::getline(file, line)) return false;
  }
  std::string_view text = line;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (text.ends_with('\r')) text.remove_suffix(1);
  std::vector<std::string_view> fields;
  std::vector<std::string> owned;
  split_fields(text, fields, owned);
  return is_header(fields) || (fields.size() >= kFewestFields && parse_number(fields.front())) ||
         looks_like_kitti_file(path);
}

void append_mot_row(std::string& text, const MotRow& row) {
  fmt::format_to(std::back_inserter(text), "{},{},{:.2f},{:.2f},{:.2f},{:.2f},{},-1,-1,-1\n",
                 row.frame, row.id, row.left, row.top, row.width, row.height, row.confidence);
}

SequenceInfo read_sequence_info(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  Findings findings(path.string());
  SequenceInfo info;
  bool in_section = false;
  const auto trimmed = [](std::string_view part) {
    const auto first = part.find_first_not_of(" \t");
    if (first == std::string_view::npos) return std::string_view{};
    return part.substr(first, part.find_last_not_of(" \t") - first + 1);
  };
  Lines lines(text);
  for (auto line = lines.next(); line && !findings.enough(); line = lines.next()) {
    const std::string_view content = trimmed(*line);
    if (content.empty() || content.front() == ';' || content.front() == '#') continue;
    if (content.front() == '[') {
      in_section = content == "[Sequence]";
      continue;
    }
    const std::size_t equals = content.find('=');
    if (equals == std::string_view::npos) {
      findings.add(lines.number(), in_quotes(content) + " is not `key = value`");
      continue;
    }
    if (!in_section) continue;
    const std::string_view key = trimmed(content.substr(0, equals));
    const std::string_view value = trimmed(content.substr(equals + 1));
    const auto whole = [&](auto& target) {
      const auto number = parse_whole(value);
      if (!number || *number < 1 || *number > std::numeric_limits<std::int32_t>::max()) {
        findings.add(lines.number(),
                     fmt::format("{} {} is not a whole number above 0", key, in_quotes(value)));
        return;
      }
      target = static_cast<std::int32_t>(*number);
    };
    if (key == "name") info.name = value;
    if (key == "seqLength") whole(info.length);
    if (key == "imWidth") whole(info.width);
    if (key == "imHeight") whole(info.height);
    if (key == "frameRate") {
      const auto rate = parse_number(value);
      if (!rate || !(*rate > 0.0)) {
        findings.add(lines.number(),
                     fmt::format("frameRate {} is not a number above 0", in_quotes(value)));
      } else {
        info.frame_rate = *rate;
      }
    }
  }
  findings.throw_if_any();
  return info;
}

}  // namespace ghtrack
