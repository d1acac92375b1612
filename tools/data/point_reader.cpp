#include "tools/data/point_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/data/fix_columns.hpp"
#include "tools/data/words.hpp"
#include "tools/record/ordered_rows.hpp"

namespace ghtrack {
namespace {

struct PointRow {
  double time = 0.0;
  std::int64_t id = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  std::int64_t line = 0;
};

/// The column of identities: by the name that our own files have, or by an alias.
std::size_t identity_column(Table& table, PointKind kind) {
  const char* name = kind == PointKind::kTruth ? "truth_id" : "track_id";
  if (const auto own = table.column(name); own && !table.columns().is_chosen(Role::kIdentity))
    return *own;
  if (table.columns().has(Role::kIdentity)) return *table.columns().find(Role::kIdentity);
  return table.required(Role::kIdentity);
}

}  // namespace

struct PointReader::State {
  State(const std::string& path, PointKind kind, const ReadOptions& options,
        std::optional<GeoPoint> known_origin)
      : table(path, options),
        identity(identity_column(table, kind)),
        fixes(table, options, known_origin),
        velocity_x(kind == PointKind::kTracks ? table.column("vx") : std::nullopt),
        velocity_y(kind == PointKind::kTracks ? table.column("vy") : std::nullopt),
        status(kind == PointKind::kTracks ? table.columns().find(Role::kStatus) : std::nullopt),
        has_names(!table.begins_with_numbers(identity)),
        rows([this](PointRow& row) { return read(row); },
             table.can_rewind() ? std::function<void()>([this] { table.rewind(); })
                                : std::function<void()>()),
        instants(rows) {}

  bool read(PointRow& row) {
    while (table.next()) {
      if (status && table.cell(*status) == "tentative") continue;
      const auto id = identity_of();
      const auto fix = fixes.read(table);
      if (!id || !fix || !fix->position) continue;
      row = {.time = fix->time, .id = *id, .position = *fix->position, .line = table.line()};
      if (velocity_x && velocity_y) {
        row.velocity = {table.number(*velocity_x).value_or(0.0),
                        table.number(*velocity_y).value_or(0.0)};
      }
      return true;
    }
    return false;
  }

  std::optional<std::int64_t> identity_of() {
    const std::string_view cell = table.cell(identity);
    if (has_names) return 1 + std::int64_t{names.number_of(cell)};
    const auto id = parse_whole(cell);
    if (!id) table.reject_cell(identity, "a whole number");
    return id;
  }

  void survey() {
    PeriodEstimate estimate;
    rows.survey([&](const PointRow& row) {
      ++row_count;
      estimate.add(row.time);
    });
    table.throw_findings();
    left_out = table.rows_left_out();
    remarks = table.remarks();
    rows.settle();
    if (!rows.in_order()) {
      estimate = {};
      for (auto at = instants.next(); !at.empty(); at = instants.next()) {
        estimate.add(at.front().time);
      }
      instants.rewind();
    }
    instant_count = estimate.instants();
    period = estimate.median();
    origin = fixes.origin() ? fixes.origin() : origin_in_columns(table);
    understood = fmt::format("{}: {} rows at {} instants ({}), {}, id from {}", table.name(),
                             row_count, instant_count, table.dialect().describe(),
                             fixes.describe(table), in_quotes(table.headings()[identity].text));
    if (!rows.in_order()) understood += "; sorted by time";
  }

  void check_identities(std::vector<PointRow>& points) {
    std::stable_sort(points.begin(), points.end(),
                     [](const PointRow& a, const PointRow& b) { return a.id < b.id; });
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i].id != points[i - 1].id) continue;
      Findings findings(table.name());
      findings.add(points[i].line,
                   fmt::format("id {} is there twice at the same time; the first is in line {}",
                               points[i].id, points[i - 1].line));
      findings.throw_if_any();
    }
  }

  Table table;
  std::size_t identity;
  FixColumns fixes;
  std::optional<std::size_t> velocity_x, velocity_y;
  std::optional<std::size_t> status;
  bool has_names;  // identities are words
  Words names;
  OrderedRows<PointRow> rows;
  Instants<PointRow> instants;
  std::int64_t row_count = 0, instant_count = 0, left_out = 0;
  double period = 0.0;
  std::vector<std::string> remarks;
  std::string understood;
  std::optional<GeoPoint> origin;
};

PointReader::PointReader(const std::string& path, PointKind kind, const ReadOptions& options,
                         std::optional<GeoPoint> origin)
    : state_(std::make_unique<State>(path, kind, options, origin)) {
  state_->survey();
}

PointReader::~PointReader() = default;
PointReader::PointReader(PointReader&&) noexcept = default;

std::int64_t PointReader::rows() const { return state_->row_count; }
std::int64_t PointReader::instants() const { return state_->instant_count; }
double PointReader::period() const { return state_->period; }
std::int64_t PointReader::left_out() const { return state_->left_out; }
const std::vector<std::string>& PointReader::remarks() const { return state_->remarks; }
const std::string& PointReader::understood() const { return state_->understood; }
const std::optional<GeoPoint>& PointReader::origin() const { return state_->origin; }
bool PointReader::are_degrees() const { return state_->fixes.origin().has_value(); }

std::vector<IdentifiedPoint> PointReader::next() {
  std::vector<PointRow> rows = state_->instants.next();
  state_->check_identities(rows);
  std::vector<IdentifiedPoint> points;
  points.reserve(rows.size());
  for (const PointRow& row : rows) points.push_back({row.time, row.id, row.position, row.velocity});
  return points;
}

std::string PointReader::name_of(std::int64_t id) const {
  const auto& names = state_->names.words();
  const bool is_name = state_->has_names && id >= 1 && id <= std::ssize(names);
  return is_name ? names[static_cast<std::size_t>(id - 1)] : std::to_string(id);
}

namespace {

std::vector<IdentifiedPoint> read_all(const std::filesystem::path& path, PointKind kind) {
  PointReader reader(path.string(), kind);
  std::vector<IdentifiedPoint> all;
  for (auto points = reader.next(); !points.empty(); points = reader.next()) {
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

}  // namespace

std::vector<IdentifiedPoint> read_truth_csv(const std::filesystem::path& path) {
  return read_all(path, PointKind::kTruth);
}

std::vector<IdentifiedPoint> read_tracks_csv(const std::filesystem::path& path) {
  return read_all(path, PointKind::kTracks);
}

}  // namespace ghtrack
