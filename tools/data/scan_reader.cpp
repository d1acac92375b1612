#include "tools/data/scan_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "tools/data/fix_columns.hpp"
#include "tools/data/words.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/ordered_rows.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostSensors = 1000;

struct DetectionRow {
  double time = 0.0;
  std::int32_t sensor = 0;
  std::int32_t label = -1;  // −1: the file has no classes
  bool is_seen = false;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();  // 0: unknown
};

}  // namespace

struct ScanReader::State {
  State(const std::string& path, const ReadOptions& options)
      : table(path, options),
        fixes(table, options),
        sensor(table.columns().find(Role::kSensor)),
        label(table.columns().find(Role::kClass)),
        rows([this](DetectionRow& row) { return read(row); },
             table.can_rewind() ? std::function<void()>([this] { rewind(); })
                                : std::function<void()>()),
        instants(rows) {}

  bool read(DetectionRow& row) {
    while (table.next()) {
      if (table.line() != line_before && table.text() == row_before) {
        ++repeated;
        continue;
      }
      row_before = table.text();
      line_before = table.line();
      const auto fix = fixes.read(table);
      if (!fix) continue;
      row.time = fix->time;
      row.is_seen = fix->position.has_value();
      if (row.is_seen) row.position = *fix->position;
      row.sigma = fixes.sigma(table).value_or(Eigen::Vector2d::Zero());
      if (label) row.label = labels.number_of(table.cell(*label));
      if (sensor) row.sensor = sensors.number_of(table.cell(*sensor));
      if (sensors.words().size() <= kMostSensors) return true;
      throw InputError(fmt::format("{}:{}: error: more than 1000 different sensors", table.name(),
                                   table.line()));
    }
    return false;
  }

  void rewind() {
    table.rewind();
    row_before.clear();
    line_before = 0;
  }

  void survey() {
    PeriodEstimate period;
    bool first = true;
    rows.survey([&](const DetectionRow& row) {
      ++summary.rows;
      summary.missed += row.is_seen ? 0 : 1;
      summary.first_time = first ? row.time : std::min(summary.first_time, row.time);
      summary.last_time = first ? row.time : std::max(summary.last_time, row.time);
      period.add(row.time);
      first = false;
    });
    table.throw_findings();
    summary.left_out = table.rows_left_out();
    summary.remarks = table.remarks();
    summary.repeated = repeated;
    rows.settle();
    summary.in_order = rows.in_order();
    summary.has_sigma = fixes.has_sigma();
    summary.sensors = sensors.words();
    summary.origin = fixes.origin();
    if (!summary.in_order) {  // the time between rows of the file is not that between instants
      period = {};
      for (auto rows_now = instants.next(); !rows_now.empty(); rows_now = instants.next()) {
        period.add(rows_now.front().time);
      }
      instants.rewind();
    }
    summary.instants = period.instants();
    summary.period = period.median();
    summary.understood = describe();
  }

  std::string describe() const {
    const auto counted = [](std::int64_t n, const char* one, const char* many) {
      return fmt::format("{} {}", n, n == 1 ? one : many);
    };
    std::string text =
        fmt::format("{}: {} at {}", table.name(), counted(summary.rows, "row", "rows"),
                    counted(summary.instants, "instant", "instants"));
    if (summary.rows > 0) {
      text += fmt::format(" over {:g} s", summary.last_time - summary.first_time);
    }
    text += fmt::format(" ({}), {}", table.dialect().describe(), fixes.describe(table));
    if (sensor) text += "; " + counted(std::ssize(summary.sensors), "sensor", "sensors");
    if (label && !table.side_by_side())
      text += "; " + counted(std::ssize(labels.words()), "class", "classes");
    if (summary.missed > 0) {
      text += fmt::format("; {} without a position", counted(summary.missed, "row", "rows"));
    }
    if (summary.repeated > 0) {
      const bool one = summary.repeated == 1;
      text += fmt::format("; {} row{} the one before and {} left out", summary.repeated,
                          one ? " repeats" : "s repeat", one ? "is" : "are");
    }
    if (!summary.in_order) text += "; sorted by time";
    text += fixes.time().doubt(table, summary.period);
    return text;
  }

  /// Fills `scan` with the rows of the present instant and the next of its sensors.
  void take_scan(Scan& scan) {
    scan.time = now[at].time;
    scan.sensor = now[at].sensor;
    scan.detections.clear();
    for (; at < now.size() && now[at].sensor == scan.sensor; ++at) {
      const DetectionRow& row = now[at];
      if (!row.is_seen) continue;
      Detection& detection = scan.detections.emplace_back();
      detection.position = row.position;
      detection.covariance = row.sigma.cwiseAbs2().asDiagonal();
      if (row.label >= 0) detection.label = labels.words()[static_cast<std::size_t>(row.label)];
    }
  }

  Table table;
  FixColumns fixes;
  std::optional<std::size_t> sensor, label;
  Words sensors, labels;
  OrderedRows<DetectionRow> rows;
  Instants<DetectionRow> instants;
  std::vector<DetectionRow> now;  // of the present instant, by sensor
  std::size_t at = 0;             // in `now`
  std::string row_before;
  std::int64_t line_before = 0;
  std::int64_t repeated = 0;
  DataSummary summary;
};

ScanReader::ScanReader(const std::string& path, const ReadOptions& options)
    : state_(std::make_unique<State>(path, options)) {
  state_->survey();
}

ScanReader::~ScanReader() = default;
ScanReader::ScanReader(ScanReader&&) noexcept = default;

const DataSummary& ScanReader::summary() const { return state_->summary; }

bool ScanReader::next(Scan& scan) {
  State& state = *state_;
  if (state.at == state.now.size()) {
    state.now = state.instants.next();
    state.at = 0;
    if (state.now.empty()) return false;
    if (state.sensor) {
      std::stable_sort(
          state.now.begin(), state.now.end(),
          [](const DetectionRow& a, const DetectionRow& b) { return a.sensor < b.sensor; });
    }
  }
  state.take_scan(scan);
  return true;
}

void ScanReader::rewind() {
  state_->instants.rewind();
  state_->now.clear();
  state_->at = 0;
}

DetectionTable read_detections_csv(const std::filesystem::path& path) {
  ScanReader reader(path.string());
  DetectionTable table;
  table.sensors = reader.summary().sensors;
  for (Scan scan; reader.next(scan);) table.scans.push_back(scan);
  return table;
}

}  // namespace ghtrack
