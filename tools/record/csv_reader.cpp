#include "tools/record/csv_reader.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "tools/record/text_file.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostRows = 5'000'000;
constexpr std::size_t kMostSensors = 1000;

/// A CSV file row by row, with its columns by name.
class Table {
 public:
  explicit Table(const std::filesystem::path& path)
      : text_(read_text_file(path)), lines_(text_), findings_(path.string()) {
    if (const auto header = lines_.next()) {
      split_fields(*header, fields_, owned_);
      for (const std::string_view field : fields_) names_.emplace_back(field);
    }
  }

  /// The index of a column that must be there.
  std::size_t required(std::string_view name) {
    if (const auto found = optional(name)) return *found;
    std::string known;
    for (const std::string& column : names_)
      known += (known.empty() ? "" : ", ") + in_quotes(column);
    findings_.add(1, "column '" + std::string(name) + "' is missing; the header row has " +
                         (known.empty() ? "nothing" : known.substr(0, 200)));
    return 0;
  }

  std::optional<std::size_t> optional(std::string_view name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) return std::nullopt;
    if (std::find(found + 1, names_.end(), name) != names_.end()) {
      findings_.add(1, "column '" + std::string(name) + "' is there twice");
    }
    return static_cast<std::size_t>(found - names_.begin());
  }

  /// Goes to the next row that is not empty; false after the last.
  bool next() {
    while (!findings_.enough()) {
      const auto line = lines_.next();
      if (!line) return false;
      if (line->find_first_not_of(" \t") == std::string_view::npos) continue;
      if (++rows_ > kMostRows) {
        fail("more than 5 000 000 rows");
        return false;
      }
      split_fields(*line, fields_, owned_);
      if (fields_.size() == names_.size()) return true;
      fail("this row has " + std::to_string(fields_.size()) + " fields; the header row has " +
           std::to_string(names_.size()));
    }
    return false;
  }

  std::string_view text(std::size_t column) const { return fields_[column]; }

  double number(std::size_t column) {
    if (const auto value = parse_number(fields_[column])) return *value;
    fail(in_quotes(fields_[column]) + " in column '" + names_[column] + "' is not a finite number");
    return 0.0;
  }

  std::int64_t whole(std::size_t column) {
    if (const auto value = parse_whole(fields_[column])) return *value;
    fail(in_quotes(fields_[column]) + " in column '" + names_[column] + "' is not a whole number");
    return 0;
  }

  std::int64_t line() const { return lines_.number(); }
  void fail(const std::string& message) { findings_.add(line(), message); }
  void fail_at(std::int64_t line, const std::string& message) { findings_.add(line, message); }
  void throw_findings() const { findings_.throw_if_any(); }

 private:
  std::string text_;
  Lines lines_;
  Findings findings_;
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;
  std::vector<std::string> owned_;
  std::size_t rows_ = 0;
};

std::vector<IdentifiedPoint> read_points(const std::filesystem::path& path,
                                         std::string_view id_column, bool tracks) {
  Table table(path);
  const std::size_t t = table.required("t");
  const std::size_t id = table.required(id_column);
  const std::size_t x = table.required("x");
  const std::size_t y = table.required("y");
  const std::optional<std::size_t> status =
      tracks ? table.optional("status") : std::optional<std::size_t>{};
  table.throw_findings();

  struct Row {
    IdentifiedPoint point;
    std::int64_t line;
  };
  std::vector<Row> rows;
  while (table.next()) {
    if (status && table.text(*status) == "tentative") continue;
    rows.push_back(
        {{table.number(t), table.whole(id), {table.number(x), table.number(y)}}, table.line()});
  }
  table.throw_findings();
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return std::tie(a.point.time, a.point.id) < std::tie(b.point.time, b.point.id);
  });
  std::vector<IdentifiedPoint> points;
  points.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const IdentifiedPoint& point = rows[i].point;
    if (i > 0 && point.time == points.back().time && point.id == points.back().id) {
      table.fail_at(rows[i].line, "id " + std::to_string(point.id) +
                                      " is there twice at the same time; the first is in line " +
                                      std::to_string(rows[i - 1].line));
    }
    points.push_back(point);
  }
  table.throw_findings();
  return points;
}

}  // namespace

std::vector<IdentifiedPoint> read_truth_csv(const std::filesystem::path& path) {
  return read_points(path, "truth_id", false);
}

std::vector<IdentifiedPoint> read_tracks_csv(const std::filesystem::path& path) {
  return read_points(path, "track_id", true);
}

DetectionTable read_detections_csv(const std::filesystem::path& path) {
  Table table(path);
  const std::size_t t = table.required("t");
  const std::size_t x = table.required("x");
  const std::size_t y = table.required("y");
  const std::optional<std::size_t> sensor = table.optional("sensor");
  const std::optional<std::size_t> label = table.optional("class");
  table.throw_findings();

  struct Row {
    double time;
    int sensor;
    Detection detection;
  };
  std::vector<Row> rows;
  DetectionTable result;
  while (table.next()) {
    Row& row = rows.emplace_back();
    row.time = table.number(t);
    row.sensor = 0;
    row.detection.position = {table.number(x), table.number(y)};
    if (label) row.detection.label = table.text(*label);
    if (!sensor) continue;
    const auto known = std::find(result.sensors.begin(), result.sensors.end(), table.text(*sensor));
    row.sensor = static_cast<int>(known - result.sensors.begin());
    if (known != result.sensors.end()) continue;
    if (result.sensors.size() == kMostSensors) table.fail("more than 1000 different sensors");
    result.sensors.emplace_back(table.text(*sensor));
  }
  table.throw_findings();
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return std::tie(a.time, a.sensor) < std::tie(b.time, b.sensor);
  });
  for (Row& row : rows) {
    if (result.scans.empty() || result.scans.back().time != row.time ||
        result.scans.back().sensor != row.sensor) {
      result.scans.push_back({row.time, row.sensor, {}});
    }
    result.scans.back().detections.push_back(std::move(row.detection));
  }
  return result;
}

}  // namespace ghtrack
