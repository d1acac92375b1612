#include "tools/record/kitti_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kFields = 17;  // and the score
constexpr std::string_view kNotLabelled = "DontCare";

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

bool has_fields(const std::vector<std::string_view>& words) {
  return words.size() == kFields || words.size() == kFields + 1;
}

std::optional<KittiRow> parse_row(const std::vector<std::string_view>& words, std::int64_t line,
                                  Findings& findings) {
  if (!has_fields(words)) {
    findings.add(line, fmt::format("{} fields; a row of KITTI has {}, or {} with a score",
                                   words.size(), kFields, kFields + 1));
    return std::nullopt;
  }
  const auto frame = parse_whole(words[0]);
  const auto id = parse_whole(words[1]);
  if (!frame || *frame < 0 || *frame >= std::numeric_limits<std::int32_t>::max()) {
    findings.add(line, fmt::format("frame {} is not a whole number from 0", in_quotes(words[0])));
    return std::nullopt;
  }
  if (!id) {
    findings.add(line, fmt::format("id {} is not a whole number", in_quotes(words[1])));
    return std::nullopt;
  }
  // truncated, occluded, left, top, right, bottom, score
  constexpr std::array<std::size_t, 7> kPlaces{3, 4, 6, 7, 8, 9, kFields};
  std::array<double, kPlaces.size()> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::size_t field = kPlaces[i];
    if (field == words.size()) break;
    const auto number = parse_number(words[field]);
    if (!number) {
      findings.add(line, fmt::format("{} in field {} is not a finite number",
                                     in_quotes(words[field]), field + 1));
      return std::nullopt;
    }
    numbers[i] = *number;
  }
  const auto& [truncated, occluded, left, top, right, bottom, score] = numbers;
  if (!(right > left) || !(bottom > top)) {
    findings.add(line, fmt::format("the box from {}, {} to {}, {} has no area", left, top, right,
                                   bottom));
    return std::nullopt;
  }
  KittiRow row{.box = {.frame = static_cast<std::int32_t>(*frame) + 1,
                       .id = *id,
                       .left = left + 1.0,
                       .top = top + 1.0,
                       .width = right - left,
                       .height = bottom - top},
               .type = std::string(words[2]),
               .truncated = static_cast<int>(std::clamp(truncated, -1.0, 9.0)),
               .occluded = static_cast<int>(std::clamp(occluded, -1.0, 9.0))};
  if (words.size() > kFields) row.box.confidence = score;
  return row;
}

}  // namespace

bool looks_like_kitti_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  while (words_of(line).empty()) {
    if (!std::getline(file, line)) return false;
  }
  const auto words = words_of(line);
  return has_fields(words) && parse_whole(words[0]) && !parse_number(words[2]);
}

KittiFile read_kitti_file(const std::filesystem::path& path, MotKind kind) {
  const std::string text = read_text_file(path);
  Findings findings(path.string());
  Lines lines(text);
  KittiFile labels;
  auto& [rows, unlabelled] = labels;
  for (auto line = lines.next(); line && !findings.enough(); line = lines.next()) {
    const auto words = words_of(*line);
    if (words.empty()) continue;
    auto row = parse_row(words, lines.number(), findings);
    if (!row) continue;
    if (row->type == kNotLabelled) {
      unlabelled.push_back(row->box);
    } else {
      rows.push_back(std::move(*row));
    }
  }
  findings.throw_if_any();
  std::ranges::stable_sort(rows, {}, [](const KittiRow& row) { return row.box.frame; });
  std::ranges::stable_sort(unlabelled, {}, &MotRow::frame);
  if (kind == MotKind::kDetections) return labels;
  std::vector<std::pair<std::int32_t, std::int64_t>> seen;
  for (const KittiRow& row : rows) seen.emplace_back(row.box.frame, row.box.id);
  std::sort(seen.begin(), seen.end());
  const auto twice = std::adjacent_find(seen.begin(), seen.end());
  if (twice != seen.end()) {
    findings.add(0, fmt::format("id {} is there twice in frame {}", twice->second,
                                twice->first - 1));
  }
  findings.throw_if_any();
  return labels;
}

void append_kitti_row(std::string& text, const KittiRow& row) {
  const MotRow& box = row.box;
  fmt::format_to(std::back_inserter(text),
                 "{} {} {} -1 -1 -10 {:.2f} {:.2f} {:.2f} {:.2f} -1 -1 -1 -1000 -1000 -1000 -10 {}\n",
                 box.frame - 1, box.id, row.type, box.left - 1.0, box.top - 1.0,
                 box.left - 1.0 + box.width, box.top - 1.0 + box.height, box.confidence);
}

}  // namespace ghtrack
