#include "tools/cli/series_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/schema/diagnostic.hpp"

namespace ghtrack::cli {
namespace {

constexpr std::size_t kRowsForStep = 200;   // that tell the typical step
constexpr std::size_t kWitnesses = 5;       // rows that may belie the stamp of one before
constexpr std::int64_t kRemarks = 10;       // more are not said
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

/// Columns `z` for one axis, `zx,zy[,zz]` for more; for other names the suffix is `_x` ….
std::vector<std::size_t> find_columns(const NumberTable& table, const std::string& name,
                                      std::size_t axes) {
  std::vector<std::size_t> columns;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const std::string suffix = axes == 1     ? std::string()
                               : name == "z" ? std::string(kAxes[axis])
                                             : std::string("_") + kAxes[axis];
    const auto found = table.column(name + suffix);
    if (!found) return {};
    columns.push_back(*found);
  }
  return columns;
}

}  // namespace

bool MeasuredRow::is_measured() const {
  return std::all_of(z.begin(), z.end(), [](const auto& value) { return value.has_value(); });
}

SeriesRows::SeriesRows(NumberTable& table, const std::string& t_column)
    : table_(table),
      g_(table.column("g")),
      h_(table.column("h")),
      k_(table.column("k")),
      dt_(table.column("dt")) {
  for (const std::size_t axes : {1U, 3U, 2U}) {
    z_ = find_columns(table, "z", axes);
    if (!z_.empty()) break;
  }
  if (z_.empty()) {
    table.fail("there is no column z, nor zx,zy[,zz]; known are the columns " +
               printable(fmt::format("{}", fmt::join(table.columns(), ", "))));
  }
  truth_ = find_columns(table, "truth", z_.size());
  if (t_column.empty()) return;
  t_ = table.column(t_column);
  if (!t_) table.fail(fmt::format("there is no column '{}'", printable(t_column)));
}

std::optional<double> SeriesRows::typical_step() {
  if (!t_) return std::nullopt;
  read_ahead(kRowsForStep);
  std::vector<double> steps;
  for (std::size_t i = 1; i < ahead_.size(); ++i) {
    const double step = *ahead_[i].t - *ahead_[i - 1].t;
    if (step > 0.0 && std::isfinite(step)) steps.push_back(step);
  }
  if (steps.empty()) return std::nullopt;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

std::optional<MeasuredRow> SeriesRows::next() {
  while (read_ahead(1)) {
    MeasuredRow row = std::move(ahead_.front());
    ahead_.pop_front();
    if (t_) {
      if (time_ && *row.t < *time_) {
        leave_out(row, "is before that of the row before");
        continue;
      }
      if (is_belied(row)) {
        leave_out(row, "is after those of the rows that follow");
        continue;
      }
      time_ = row.t;
    }
    return row;
  }
  return std::nullopt;
}

/// Do most of the next rows go on from the row before as if this one were not there?
bool SeriesRows::is_belied(const MeasuredRow& row) {
  read_ahead(kWitnesses);
  const std::size_t witnesses = std::min(kWitnesses, ahead_.size());
  const auto belies = [&](const MeasuredRow& later) {
    return *later.t < *row.t && (!time_ || *later.t >= *time_);
  };
  const auto count = std::count_if(
      ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(witnesses), belies);
  return 2 * static_cast<std::size_t>(count) > witnesses;
}

void SeriesRows::leave_out(const MeasuredRow& row, const char* why) {
  ++left_out_;
  if (left_out_ > kRemarks + 1) return;
  remarks_.push_back(left_out_ <= kRemarks
                         ? fmt::format("{}: warning: the time {} {}; the row is left out",
                                       table_.place(row.line), *row.t, why)
                         : table_.place(row.line) + ": warning: more rows like this are left out");
}

std::vector<std::string> SeriesRows::take_remarks() { return std::exchange(remarks_, {}); }

bool SeriesRows::read_ahead(std::size_t rows) {
  while (ahead_.size() < rows && table_.next()) ahead_.push_back(parse(++rows_));
  return ahead_.size() >= rows;
}

MeasuredRow SeriesRows::parse(std::int64_t number) const {
  const auto cell = [&](const std::optional<std::size_t>& column) {
    return column ? table_.cell(*column) : std::nullopt;
  };
  MeasuredRow row{.number = number,
                .line = table_.line(),
                .t = cell(t_),
                .dt = cell(dt_),
                .g = cell(g_),
                .h = cell(h_),
                .k = cell(k_),
                .z = {},
                .truth = {}};
  if (t_ && (!row.t || !std::isfinite(*row.t))) table_.fail("the time is missing or not finite");
  for (const std::size_t column : z_) row.z.push_back(table_.cell(column));
  for (const std::size_t column : truth_) row.truth.push_back(table_.cell(column));
  return row;
}

}  // namespace ghtrack::cli
