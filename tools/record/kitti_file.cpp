#include "tools/record/kitti_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/record/frame_reader.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kFields = 17;  // and the score

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

std::optional<KittiRow> parse_kitti_row(std::string_view line, std::int64_t line_number,
                                        Findings& findings) {
  const auto words = words_of(line);
  if (words.empty()) return std::nullopt;
  if (!has_fields(words)) {
    findings.add(line_number, fmt::format("{} fields; a row of KITTI has {}, or {} with a score",
                                          words.size(), kFields, kFields + 1));
    return std::nullopt;
  }
  const auto frame = parse_whole(words[0]);
  const auto id = parse_whole(words[1]);
  if (!frame || *frame < 0 || *frame >= std::numeric_limits<std::int32_t>::max()) {
    findings.add(line_number,
                 fmt::format("frame {} is not a whole number from 0", in_quotes(words[0])));
    return std::nullopt;
  }
  if (!id) {
    findings.add(line_number, fmt::format("id {} is not a whole number", in_quotes(words[1])));
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
      findings.add(line_number, fmt::format("{} in field {} is not a finite number",
                                            in_quotes(words[field]), field + 1));
      return std::nullopt;
    }
    numbers[i] = *number;
  }
  const auto& [truncated, occluded, left, top, right, bottom, score] = numbers;
  if (!(right > left) || !(bottom > top)) {
    findings.add(line_number, fmt::format("the box from {}, {} to {}, {} has no area", left, top,
                                          right, bottom));
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

struct KittiReader::State {
  State(const std::filesystem::path& path, MotKind that, std::function<void()> pause)
      : kind(that),
        frames(
            path.string(),
            [](std::string_view line, std::int64_t number,
               Findings& findings) -> std::optional<FileRow<KittiRow>> {
              auto row = parse_kitti_row(line, number, findings);
              if (!row) return std::nullopt;
              return FileRow<KittiRow>{static_cast<double>(row->box.frame), number,
                                       std::move(*row)};
            },
            [this](const KittiRow& row) { types.insert(row.type); }, std::move(pause)) {}

  std::set<std::string> types;
  MotKind kind;
  FrameReader<KittiRow> frames;
  std::vector<KittiRow> now;  // of the present frame
};

KittiReader::KittiReader(const std::filesystem::path& path, MotKind kind,
                         std::function<void()> pause)
    : state_(std::make_unique<State>(path, kind, std::move(pause))) {}

KittiReader::~KittiReader() = default;
KittiReader::KittiReader(KittiReader&&) noexcept = default;

bool KittiReader::in_order() const { return state_->frames.in_order(); }
const std::set<std::string>& KittiReader::types() const { return state_->types; }

std::span<const KittiRow> KittiReader::next() {
  std::vector<KittiRow>& now = state_->now;
  now.clear();
  std::vector<std::pair<std::int64_t, std::int64_t>> ids;
  for (const FileRow<KittiRow>& read : state_->frames.next()) {
    now.push_back(read.row);
    const bool is_object = read.row.type != kNotLabelled;
    if (is_object && state_->kind != MotKind::kDetections) {
      ids.emplace_back(read.row.box.id, read.line);
    }
  }
  if (!ids.empty()) state_->frames.refuse_twins(std::move(ids), now.front().box.frame - 1);
  return now;
}

void KittiReader::rewind() { state_->frames.rewind(); }

void append_kitti_row(std::string& text, const KittiRow& row) {
  const MotRow& box = row.box;
  const double left = box.left - 1.0, top = box.top - 1.0;
  fmt::format_to(std::back_inserter(text), "{} {} {} -1 -1 -10", box.frame - 1, box.id, row.type);
  for (const double value : {left, top, left + box.width, top + box.height}) {
    text += ' ';
    append_hundredths(text, value);
  }
  fmt::format_to(std::back_inserter(text), " -1 -1 -1 -1000 -1000 -1000 -10 {}\n", box.confidence);
}

}  // namespace ghtrack
