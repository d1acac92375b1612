#include "tools/record/mot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string_view>
#include <utility>

#include "tools/record/box_fields.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/frame_reader.hpp"
#include "tools/record/kitti_file.hpp"
#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kFewestFields = 6;
constexpr std::size_t kMostFields = 10;
constexpr std::size_t kTruthFields = 9;  // of ground truth with categories

using Values = std::array<double, kMostFields>;

/// What the rows of a file must keep to.
struct MotRules {
  MotKind kind;
  std::int32_t last_frame;
  std::int32_t first_frame = 1;  // 0 under a header with names

  bool allows_frame(double value) const {
    const std::optional<std::int64_t> frame = as_whole(value);
    return frame && *frame >= first_frame && *frame <= last_frame;
  }
};

/// The row that so many values make; absent if they make none.
std::optional<MotRow> row_of(const Values& values, std::size_t count, const MotRules& rules) {
  const std::optional<std::int64_t> id = as_whole(values[1]);
  const bool has_area = values[4] > 0.0 && values[5] > 0.0;
  if (!rules.allows_frame(values[0]) || !id || !has_area) return std::nullopt;
  MotRow row{.frame = static_cast<std::int32_t>(values[0]),
             .id = *id,
             .left = values[2],
             .top = values[3],
             .width = values[4],
             .height = values[5]};
  if (count > kFewestFields) row.confidence = values[6];
  if (rules.kind != MotKind::kDetections && count == kTruthFields) {
    row.category = static_cast<std::int32_t>(std::clamp(values[7], -1.0, 1e6));
  }
  return row;
}

/// Reports why values make no row.
/// @param texts  of the values as the line has them
void add_fault(const Values& values, const std::array<std::string_view, kMostFields>& texts,
               const MotRules& rules, std::int64_t line, Findings& findings) {
  if (!rules.allows_frame(values[0])) {
    findings.add(line, fmt::format("frame {} is not a whole number from {} to {}",
                                   in_quotes(texts[0]), rules.first_frame, rules.last_frame));
  } else if (!as_whole(values[1])) {
    findings.add(line, fmt::format("id {} is not a whole number", in_quotes(texts[1])));
  } else {
    findings.add(line, fmt::format("width {} and height {} must be above 0", in_quotes(texts[4]),
                                   in_quotes(texts[5])));
  }
}

/// Turns the fields of a line into a row, or reports what is wrong with it.
std::optional<MotRow> parse_row(const std::vector<std::string_view>& fields, const MotRules& rules,
                                std::int64_t line, Findings& findings) {
  if (fields.size() < kFewestFields || fields.size() > kMostFields) {
    findings.add(line, fmt::format("{} fields; a row has frame,id,left,top,width,height and up to "
                                   "{} fields in all",
                                   fields.size(), kMostFields));
    return std::nullopt;
  }
  constexpr std::array<std::string_view, kMostFields> kNames = {
      "frame", "id", "left", "top", "width", "height", "conf", "x", "y", "z"};
  Values values{};
  std::array<std::string_view, kMostFields> texts;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<double> value = parse_number(fields[i]);
    if (!value) {
      findings.add(line, fmt::format("{} in field {} ({}) is not a finite number",
                                     in_quotes(fields[i]), i + 1, kNames[i]));
      return std::nullopt;
    }
    values[i] = *value;
    texts[i] = fields[i];
  }
  const std::optional<MotRow> row = row_of(values, fields.size(), rules);
  if (!row) add_fault(values, texts, rules, line, findings);
  return row;
}

/// Whether a field says that there is no value.
bool is_absent(std::string_view field) {
  constexpr std::array<std::string_view, 8> kWords = {"",   "nan", "NaN",  "NAN",
                                                      "NA", "N/A", "None", "null"};
  return std::find(kWords.begin(), kWords.end(), field) != kWords.end();
}

/// The same of a line below a header that names its fields. One without a box is an image in which
/// nothing was found.
std::optional<MotRow> parse_named_row(const std::vector<std::string_view>& fields,
                                      const BoxFields& named, const MotRules& rules,
                                      std::int64_t line, Findings& findings) {
  if (fields.size() < named.needed || fields.size() > named.named) {
    findings.add(line, fmt::format("this row has {} fields; the header row has {}", fields.size(),
                                   named.named));
    return std::nullopt;
  }
  for (const std::size_t field : {named.x, named.y, named.across, named.down}) {
    if (is_absent(fields[field])) return std::nullopt;
  }
  bool is_sound = true;
  const auto number = [&](std::size_t field) {
    auto value = parse_number(fields[field]);
    if (!value) value = parse_number(fields[field], ',');  // between semicolons
    if (!value && is_sound) {
      findings.add(line, fmt::format("{} in field {} is not a finite number",
                                     in_quotes(fields[field]), field + 1));
    }
    is_sound = is_sound && value.has_value();
    return value.value_or(0.0);
  };
  const double frame = number(named.frame);
  const double id = named.id ? number(*named.id) : -1.0;
  const BoxFields::Box box =
      named.box(number(named.x), number(named.y), number(named.across), number(named.down));
  const bool has_confidence = named.confidence && !is_absent(fields[*named.confidence]);
  const double confidence = has_confidence ? number(*named.confidence) : 1.0;
  if (!is_sound) return std::nullopt;
  const Values values = {frame, id, box.left, box.top, box.width, box.height, confidence};
  const std::optional<MotRow> row = row_of(values, kFewestFields + 1, rules);
  if (row) return row;
  const std::string width = fmt::format("{:g}", box.width);
  const std::string height = fmt::format("{:g}", box.height);
  add_fault(values, {fields[named.frame], named.id ? fields[*named.id] : "", "", "", width, height},
            rules, line, findings);
  return std::nullopt;
}

bool is_blank_or_comment(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t\r");
  return start == std::string_view::npos || line[start] == '#';
}

/// A header in the order of MOTChallenge, whatever its words: "frame,id,bb_left,bb_top,…".
bool is_header(const std::vector<std::string_view>& fields) {
  const auto says = [&](std::size_t i, std::string_view word) {
    return fields[i].find(word) != std::string_view::npos;
  };
  return fields.size() >= kFewestFields && says(0, "rame") && (says(2, "eft") || says(2, "x"));
}

/// Splits a line into fields; also at blanks where there is nothing else between numbers, and
/// without empty fields at the end, as some detectors write them.
void split_mot_fields(std::string_view line, std::vector<std::string_view>& fields,
                      std::vector<std::string>& owned) {
  split_fields(line, fields, owned);
  if (fields.size() == 1) {
    constexpr std::string_view kBlanks = " \t";
    std::string_view rest = fields.front();
    fields.clear();
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find_first_of(kBlanks), rest.size());
      fields.push_back(rest.substr(0, end));
      rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks, end), rest.size()));
    }
  }
  while (fields.size() > kFewestFields && fields.back().empty()) fields.pop_back();
}

/// Whether fields between blanks are a row of a box and not of numbers of any kind: frame and
/// identity are whole, width and height above 0.
bool looks_like_box(const std::vector<std::string_view>& fields) {
  if (fields.size() < kFewestFields || fields.size() > kMostFields) return false;
  std::array<double, kMostFields> values{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto value = parse_number(fields[i]);
    if (!value) return false;
    values[i] = *value;
  }
  return as_whole(values[0]) && values[0] >= 1.0 && as_whole(values[1]) && values[1] >= -1.0 &&
         values[4] > 0.0 && values[5] > 0.0;
}

/// Understands the lines of a file, the first of which may be a header.
class MotParser {
 public:
  explicit MotParser(MotRules rules) : rules_(rules) {}

  std::optional<MotRow> operator()(std::string_view line, std::int64_t number, Findings& findings) {
    Values values{};
    const std::size_t count = named_ ? 0 : plain_numbers(line, values);
    if (count >= kFewestFields) {
      if (first_ == 0) first_ = number;
      if (const auto row = row_of(values, count, rules_)) return row;
    }
    if (is_blank_or_comment(line)) return std::nullopt;
    if (named_) {
      split_fields(line, fields_, owned_);
    } else {
      split_mot_fields(line, fields_, owned_);
    }
    if (named_ && fields_.size() == named_->named && BoxFields::find(fields_)) return std::nullopt;
    if (first_ == 0) first_ = number;
    if (number == first_) {
      named_ = BoxFields::find(fields_);
      if (named_) rules_.first_frame = 0;
      if (named_ || is_header(fields_)) return std::nullopt;
    }
    return named_ ? parse_named_row(fields_, *named_, rules_, number, findings)
                  : parse_row(fields_, rules_, number, findings);
  }

 private:
  MotRules rules_;
  std::int64_t first_ = 0;  // line that is not empty
  std::optional<BoxFields> named_;
  std::vector<std::string_view> fields_;
  std::vector<std::string> owned_;
};

/// The box of a line of labels, if it is an object's.
std::optional<MotRow> labelled_box(std::string_view line, std::int64_t number, Findings& findings) {
  const std::optional<KittiRow> label = parse_kitti_row(line, number, findings);
  if (!label || label->type == kNotLabelled) return std::nullopt;
  return label->box;
}

}  // namespace

BoxSource frames_of(std::span<const MotRow> rows) {
  return [rows]() mutable {
    std::size_t count = 0;
    while (count < rows.size() && rows[count].frame == rows.front().frame) ++count;
    const auto frame = rows.first(count);
    rows = rows.subspan(count);
    return frame;
  };
}

struct MotReader::State {
  State(const std::filesystem::path& path, MotKind that, std::optional<std::int32_t> last_frame,
        std::function<void()> pause)
      : kind(that),
        is_kitti(looks_like_kitti_file(path)),
        frames(
            path.string(),
            [this, parse = MotParser(
                       {kind, last_frame.value_or(std::numeric_limits<std::int32_t>::max())})](
                std::string_view line, std::int64_t number,
                Findings& findings) mutable -> std::optional<FileRow<MotRow>> {
              const auto row =
                  is_kitti ? labelled_box(line, number, findings) : parse(line, number, findings);
              if (!row) return std::nullopt;
              return FileRow<MotRow>{static_cast<double>(row->frame), number, *row};
            },
            [this](const MotRow& row) {
              ++rows;
              farthest = std::max({farthest, row.left + row.width, row.top + row.height});
              from_zero = from_zero || row.frame == 0;
              has_categories = has_categories || row.category != -1;
            },
            std::move(pause)) {}

  std::int64_t rows = 0;
  double farthest = 0.0;  // corner of a box [px]
  bool has_categories = false;
  bool from_zero = false;  // the file counts frames
  MotKind kind;
  bool is_kitti;
  FrameReader<MotRow> frames;
  std::vector<MotRow> now;  // of the present frame
};

MotReader::MotReader(const std::filesystem::path& path, MotKind kind,
                     std::optional<std::int32_t> last_frame, std::function<void()> pause)
    : state_(std::make_unique<State>(path, kind, last_frame, std::move(pause))) {
  constexpr double kFraction = 2.0;  // of a picture; as pixels it would be a corner of one
  if (kind == MotKind::kDetections && state_->rows > 0 && state_->farthest < kFraction) {
    throw InputError(path.string() +
                     ": error: the boxes are fractions of the picture; multiply them by its width "
                     "and height");
  }
}

MotReader::~MotReader() = default;
MotReader::MotReader(MotReader&&) noexcept = default;

std::int64_t MotReader::rows() const { return state_->rows; }
bool MotReader::in_order() const { return state_->frames.in_order(); }
bool MotReader::counts_from_zero() const { return state_->from_zero; }
bool MotReader::has_categories() const { return state_->has_categories; }

std::span<const MotRow> MotReader::next() {
  std::vector<MotRow>& now = state_->now;
  now.clear();
  std::vector<std::pair<std::int64_t, std::int64_t>> ids;
  for (const FileRow<MotRow>& read : state_->frames.next()) {
    now.push_back(read.row);
    if (state_->from_zero) ++now.back().frame;
    const bool is_ignored = state_->kind == MotKind::kTruth && read.row.confidence == 0.0;
    if (!is_ignored && state_->kind != MotKind::kDetections)
      ids.emplace_back(read.row.id, read.line);
  }
  if (!ids.empty()) {
    const std::int32_t first = state_->is_kitti || state_->from_zero ? 0 : 1;
    state_->frames.refuse_twins(std::move(ids), now.front().frame - 1 + first);
  }
  return now;
}

void MotReader::rewind() { state_->frames.rewind(); }

std::vector<MotRow> read_mot_file(const std::filesystem::path& path, MotKind kind,
                                  std::optional<std::int32_t> last_frame) {
  MotReader reader(path, kind, last_frame);
  std::vector<MotRow> rows;
  rows.reserve(static_cast<std::size_t>(reader.rows()));
  for (auto frame = reader.next(); !frame.empty(); frame = reader.next()) {
    rows.insert(rows.end(), frame.begin(), frame.end());
  }
  return rows;
}

bool looks_like_mot_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::string_view text;
  while (is_blank_or_comment(text)) {
    if (!std::getline(file, line)) return false;
    text = line;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  }
  if (text.ends_with('\r')) text.remove_suffix(1);
  std::vector<std::string_view> fields;
  std::vector<std::string> owned;
  split_fields(text, fields, owned);
  if (BoxFields::find(fields) || is_header(fields) ||
      (fields.size() >= kFewestFields && parse_number(fields.front())) ||
      looks_like_kitti_file(path)) {
    return true;
  }
  if (fields.size() > 1) return false;
  split_mot_fields(text, fields, owned);
  return looks_like_box(fields);
}

void append_mot_row(std::string& text, const MotRow& row) {
  const auto append = [&](const fmt::format_int& whole) {
    text.append(whole.data(), whole.size());
  };
  append(fmt::format_int(row.frame));
  text += ',';
  append(fmt::format_int(row.id));
  for (const double value : {row.left, row.top, row.width, row.height}) {
    text += ',';
    append_hundredths(text, value);
  }
  text += ',';
  if (row.confidence == 1.0) {  // as of every track
    text += '1';
  } else {
    fmt::format_to(std::back_inserter(text), "{}", row.confidence);
  }
  text += ",-1,-1,-1\n";
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
