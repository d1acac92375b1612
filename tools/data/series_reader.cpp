#include "tools/data/series_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <utility>

#include "tools/data/geographic_columns.hpp"
#include "tools/data/grid_zone.hpp"
#include "tools/data/time_column.hpp"
#include "tools/data/time_order.hpp"
#include "tools/record/errors.hpp"
#include "tools/record/ordered_rows.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kRowsForStep = 200;  // of a pipe that tell the typical step
constexpr std::size_t kWitnesses = 5;      // rows that may belie the time of one before
constexpr std::int64_t kWarnings = 10;     // more are not said
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

/// What is measured: a column for each axis, or places of the earth.
struct Measured {
  std::vector<std::size_t> columns;
  std::optional<GeographicColumns> degrees;
};

/// Columns whose names are a stem with the suffix of each axis; none if there are fewer than two.
std::vector<std::size_t> by_axis(const Table& table, const std::string& stem) {
  std::vector<std::size_t> columns;
  for (const char* axis : kAxes) {
    const auto found = table.column_with_base(stem + axis);
    if (!found) break;
    columns.push_back(*found);
  }
  return columns.size() > 1 ? columns : std::vector<std::size_t>{};
}

/// The only column that has no meaning of its own.
std::optional<std::size_t> only_column_left(const Table& table) {
  std::optional<std::size_t> left;
  for (std::size_t i = 0; i < table.headings().size(); ++i) {
    const std::string& name = table.headings()[i].text;
    const bool is_known = table.columns().has_role(i) || name == "g" || name == "h" ||
                          name == "k" || table.column_with_unit("dt") == i ||
                          name.starts_with("truth");
    if (is_known) continue;
    if (left) return std::nullopt;
    left = i;
  }
  return left;
}

Measured find_measured(Table& table) {
  const ColumnMap& columns = table.columns();
  const auto x = columns.find(Role::kX), y = columns.find(Role::kY), z = columns.find(Role::kZ);
  if (columns.is_chosen(Role::kZ)) return {{*z}, {}};
  const bool plane_is_chosen = columns.is_chosen(Role::kX) || columns.is_chosen(Role::kY);
  if (plane_is_chosen && x && y) return {{*x, *y}, {}};
  if (plane_is_chosen) return {{x ? *x : *y}, {}};
  for (const char* stem : {"z", "z_", ""}) {
    if (auto axes = by_axis(table, stem); !axes.empty()) return {std::move(axes), {}};
  }
  if (const auto own = table.column("z")) return {{*own}, {}};
  if (auto degrees = GeographicColumns::find(table)) return {{}, std::move(degrees)};
  if (x && y) return {{*x, *y}, {}};
  for (const auto& one : {z, x, y, only_column_left(table)}) {
    if (one) return {{*one}, {}};
  }
  return {};
}

/// Whether it is what `ghtrack filter` writes, where k counts rows.
bool is_filtered(const Table& table) { return table.column("x_pred") || table.column("x_pred_x"); }

/// A column of numbers in a unit.
struct Quantity {
  std::size_t column = 0;
  Scale scale;

  Quantity(const Table& table, std::size_t index, const Scale& usual = {})
      : column(index), scale(usual) {
    const auto& unit = table.headings()[index].unit;
    if (unit && !unit->is_time) scale = Scale(unit->scale);
  }
};

}  // namespace

struct SeriesReader::State {
  State(const std::string& path, const ReadOptions& options, SeriesTimes wanted)
      : table(path, options),
        g(table.column("g")),
        h(table.column("h")),
        k(is_filtered(table) ? std::nullopt : table.column("k")),
        dt_column(table.column_with_unit("dt")),
        identity(table.columns().find(Role::kIdentity)) {
    if (table.side_by_side()) refuse_several_objects();
    Measured measured = find_measured(table);
    degrees = std::move(measured.degrees);
    if (measured.columns.empty() && !degrees) table.required(Role::kZ);
    const bool are_asked = table.columns().is_chosen(Role::kTime) || options.frame_rate;
    const bool are_there = TimeColumn::is_in(table, options) && !dt_column;
    if (are_asked || (are_there && wanted == SeriesTimes::kIfThere)) times.emplace(table, options);
    table.throw_missing_columns();
    for (const std::size_t column : measured.columns) axes.emplace_back(table, column);
    if (axes.size() > 1) zone = GridZone::find(table);
    for (std::size_t axis = 0; axis < dimensions(); ++axis) {
      const std::string suffix = dimensions() == 1 ? "" : std::string("_") + kAxes[axis];
      if (const auto column = table.column_with_unit("truth" + suffix)) {
        truth.emplace_back(table, *column, degrees ? Scale() : axes[axis].scale);
      }
    }
    if (truth.size() < dimensions()) truth.clear();
    is_file = table.can_rewind();
  }

  [[noreturn]] void refuse_several_objects() const {
    const auto& columns = table.side_by_side()->objects.front().columns;
    throw InputError(fmt::format(
        "{}: error: there are {}; a series is of one: name its columns by --columns, such as "
        "x={},y={}",
        table.name(), table.side_by_side()->describe(),
        columns[*table.columns().find(Role::kX)] + 1,
        columns[*table.columns().find(Role::kY)] + 1));
  }

  std::size_t dimensions() const { return degrees ? 2 : axes.size(); }

  /// Goes through a file once: is it sound, and are its rows in order?
  void survey() {
    PeriodEstimate period;
    bool in_order = true;
    for (MeasuredRow row; parse(row);) {
      ++rows;
      missed += row.z ? 0 : 1;
      if (!row.time) continue;
      in_order = in_order && (rows == 1 || *row.time >= latest);
      latest = *row.time;
      period.add(latest);
    }
    table.throw_findings();
    if (rows == 0) throw InputError(table.name() + ": error: there are no measurements");
    left_out = table.rows_left_out();
    remarks = table.remarks();
    table.rewind();
    count = 0;
    if (!in_order) {
      period = {};
      put_in_order();
      for (const MeasuredRow& row : held) period.add(*row.time);
    }
    if (period.median() > 0.0) step = period.median();
  }

  void put_in_order() {
    is_sorted = true;
    std::vector<MeasuredRow> all;
    std::vector<double> stamps;
    for (MeasuredRow row; parse(row);) {
      stamps.push_back(*row.time);
      all.push_back(std::move(row));
    }
    const std::vector<Placing> places = placings(stamps);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (places[i] == Placing::kKeep) {
        held.push_back(std::move(all[i]));
      } else {
        warn(all[i], places[i]);
      }
    }
    const auto by_time = [](const MeasuredRow& a, const MeasuredRow& b) { return a.time < b.time; };
    are_moved = !std::is_sorted(held.begin(), held.end(), by_time);
    if (!are_moved) return;
    std::stable_sort(held.begin(), held.end(), by_time);
    for (std::size_t i = 0; i < held.size(); ++i) {
      held[i].number = static_cast<std::int64_t>(i) + 1;
    }
  }

  void warn(const MeasuredRow& row, Placing placing) {
    ++false_times;
    if (false_times > kWarnings + 1) return;
    const std::string place = fmt::format("{}:{}: warning: ", table.name(), row.line);
    warnings.push_back(place + (false_times > kWarnings
                                    ? std::string("more rows like this are left out")
                                    : fmt::format("the time {} {}; the row is left out", *row.time,
                                                  placing == Placing::kLate
                                                      ? "is before that of the row before"
                                                      : "is after those of the rows that follow")));
  }

  /// The next sound row of the table; false after the last.
  bool parse(MeasuredRow& row) {
    while (table.next()) {
      if (zone) zone->check(table);
      row = {.number = count + 1,
             .line = table.line(),
             .time = times ? times->read(table) : std::nullopt,
             .dt = step_of_row(),
             .g = optional_number(g),
             .h = optional_number(h),
             .k = optional_number(k),
             .z = degrees ? place() : values(axes),
             .truth = values(truth)};
      if (!table.is_rejected()) {
        note_object();
        ++count;
        return true;
      }
      if (!is_file) table.throw_findings();
    }
    if (!is_file) table.throw_findings();
    return false;
  }

  void note_object() {
    if (!identity || has_many_objects) return;
    if (count == 0) object = table.cell(*identity);
    has_many_objects = table.cell(*identity) != object;
  }

  std::optional<double> optional_number(const std::optional<std::size_t>& column) {
    return column ? table.number_or_missing(*column) : std::nullopt;
  }

  std::optional<double> step_of_row() {
    const auto number = optional_number(dt_column);
    const auto& unit = dt_column ? table.headings()[*dt_column].unit : std::nullopt;
    return number && unit && unit->is_time ? Scale(unit->scale)(*number) : number;
  }

  /// Absent if one is missing.
  std::optional<AxisVector> values(const std::vector<Quantity>& quantities) {
    if (quantities.empty()) return std::nullopt;
    AxisVector all(static_cast<Eigen::Index>(quantities.size()));
    bool complete = true;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      const auto number = table.number_or_missing(quantities[i].column);
      complete = complete && number.has_value();
      all[static_cast<Eigen::Index>(i)] = quantities[i].scale(number.value_or(0.0));
    }
    return complete ? std::optional(all) : std::nullopt;
  }

  std::optional<AxisVector> place() {
    const auto metres = degrees->read(table);
    return metres ? std::optional<AxisVector>(*metres) : std::nullopt;
  }

  // A pipe, row by row.

  bool read_ahead(std::size_t wanted) {
    MeasuredRow row;
    while (ahead.size() < wanted && parse(row)) ahead.push_back(row);
    return ahead.size() >= wanted;
  }

  /// Do most of the next rows go on from the row before as if this one were not there?
  bool is_belied(const MeasuredRow& row) {
    read_ahead(kWitnesses);
    const std::size_t witnesses = std::min(kWitnesses, ahead.size());
    const auto belies = [&](const MeasuredRow& later) {
      return *later.time < *row.time && (!has_latest || *later.time >= latest);
    };
    const auto against = std::count_if(
        ahead.begin(), ahead.begin() + static_cast<std::ptrdiff_t>(witnesses), belies);
    return 2 * static_cast<std::size_t>(against) > witnesses;
  }

  std::optional<MeasuredRow> next_of_pipe() {
    while (read_ahead(1)) {
      MeasuredRow row = std::move(ahead.front());
      ahead.pop_front();
      if (row.time) {
        const bool is_late = has_latest && *row.time < latest;
        if (is_late || is_belied(row)) {
          warn(row, is_late ? Placing::kLate : Placing::kBelied);
          continue;
        }
        latest = *row.time;
        has_latest = true;
      }
      return row;
    }
    return std::nullopt;
  }

  std::optional<double> step_of_pipe() {
    read_ahead(kRowsForStep);
    PeriodEstimate period;
    for (const MeasuredRow& row : ahead) period.add(*row.time);
    return period.median() > 0.0 ? std::optional(period.median()) : std::nullopt;
  }

  std::string unit_of(const Quantity& quantity) const {
    const auto& unit = table.headings()[quantity.column].unit;
    if (!unit || unit->is_time) return "";
    return fmt::format(" ({}{})", unit->name, unit->scale == 1.0 ? "" : ", as m");
  }

  std::string describe() const {
    std::string text = table.name() + ":";
    if (is_file) text += fmt::format(" {} rows", rows);
    text += fmt::format(" ({}), {}, ", table.dialect().describe(),
                        times ? times->describe(table) : "evenly spaced");
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (i > 0) text += ", ";
      text += axes.size() == 1 ? "z" : std::string("z") + kAxes[i];
      text += unit_of(axes[i]) + " from " + name_of_quantity(table, axes[i].column);
    }
    if (degrees) text += "zx and zy " + degrees->describe(table);
    if (missed > 0) text += fmt::format("; {} rows without a measurement", missed);
    if (has_many_objects) {
      text += "; rows of several objects by " + name_of_column(table, *identity) +
              ", taken for one series";
    }
    if (are_moved) text += "; sorted by time";
    if (times) text += times->doubt(table, step.value_or(0.0));
    return text;
  }

  bool is_plain() const {
    const Dialect& dialect = table.dialect();
    return dialect.separator == ',' && dialect.point == '.' && !are_moved &&
           (!times || times->is_plain(table)) && !degrees && !has_many_objects &&
           std::all_of(axes.begin(), axes.end(), [&](const Quantity& axis) {
             const std::string& name = table.headings()[axis.column].text;
             return name == "z" || name == "zx" || name == "zy" || name == "zz";
           });
  }

  Table table;
  std::optional<TimeColumn> times;
  std::vector<Quantity> axes, truth;
  std::optional<GeographicColumns> degrees;  // instead of axes
  std::optional<GridZone> zone;
  std::optional<std::size_t> g, h, k, dt_column;
  std::optional<std::size_t> identity;
  std::string object;  // that the first row is of
  bool has_many_objects = false;
  bool is_file = false;
  std::int64_t count = 0;  // sound rows that have been read

  // Of a file, once it has been surveyed.
  std::int64_t rows = 0, missed = 0;
  std::optional<double> step;
  bool is_sorted = false;  // its rows are held
  bool are_moved = false;
  std::vector<MeasuredRow> held;
  std::size_t at = 0;

  // Of a pipe.
  std::deque<MeasuredRow> ahead;
  bool has_latest = false;
  double latest = 0.0;  // time of the row before

  std::int64_t left_out = 0;
  std::vector<std::string> remarks;
  std::int64_t false_times = 0;
  std::vector<std::string> warnings;
};

SeriesReader::SeriesReader(const std::string& path, const ReadOptions& options, SeriesTimes times)
    : state_(std::make_unique<State>(path, options, times)) {
  if (state_->is_file) state_->survey();
}

SeriesReader::~SeriesReader() = default;
SeriesReader::SeriesReader(SeriesReader&&) noexcept = default;

std::size_t SeriesReader::axes() const { return state_->dimensions(); }
bool SeriesReader::has_times() const { return state_->times.has_value(); }
std::string SeriesReader::understood() const { return state_->describe(); }
bool SeriesReader::is_plain() const { return state_->is_plain(); }

std::optional<double> SeriesReader::typical_step() {
  if (!has_times()) return std::nullopt;
  return state_->is_file ? state_->step : state_->step_of_pipe();
}

std::optional<MeasuredRow> SeriesReader::next() {
  State& state = *state_;
  if (!state.is_file) return state.next_of_pipe();
  if (state.is_sorted) {
    if (state.at == state.held.size()) return std::nullopt;
    return std::move(state.held[state.at++]);
  }
  MeasuredRow row;
  if (!state.parse(row)) return std::nullopt;
  return row;
}

std::int64_t SeriesReader::left_out() const {
  return state_->is_file ? state_->left_out : state_->table.rows_left_out();
}

const std::vector<std::string>& SeriesReader::remarks() const {
  return state_->is_file ? state_->remarks : state_->table.remarks();
}

std::vector<std::string> SeriesReader::take_warnings() {
  return std::exchange(state_->warnings, {});
}

}  // namespace ghtrack
