// `ghtrack filter`: a series of measurements through one filter, row by row.

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/number_table.hpp"
#include "tools/cli/series_filter.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack::cli {
namespace {

constexpr std::size_t kOutputBlock = std::size_t{1} << 16U;
constexpr std::array<const char*, 3> kAxes = {"_x", "_y", "_z"};

/// Where in the table a quantity with one value per axis is found.
template <int D>
using AxisColumns = std::array<std::size_t, D>;

template <int D>
Eigen::Matrix<double, D, 1> parse_vector(const std::string& text, const char* option) {
  Eigen::Matrix<double, D, 1> value = Eigen::Matrix<double, D, 1>::Zero();
  if (text.empty()) return value;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int axis = 0; axis < D; ++axis) {
    const auto [next, error] = std::from_chars(at, end, value[axis]);
    const bool ends_well = axis + 1 < D ? next != end && *next == ',' : next == end;
    if (error != std::errc{} || !ends_well || !std::isfinite(value[axis])) {
      throw UsageError(
          fmt::format("filter: {} is '{}'; needed are {} finite numbers, separated by commas",
                      option, printable(text), D));
    }
    at = next + (axis + 1 < D ? 1 : 0);
  }
  return value;
}

/// Columns `z` for one axis, `zx,zy[,zz]` for more; for other names the suffix is `_x` ….
template <int D>
std::optional<AxisColumns<D>> find_columns(const NumberTable& table, const std::string& name) {
  AxisColumns<D> columns{};
  for (int axis = 0; axis < D; ++axis) {
    const std::string suffix = D == 1 ? "" : name == "z" ? kAxes[axis] + 1 : kAxes[axis];
    const auto found = table.column(name + suffix);
    if (!found) return std::nullopt;
    columns[axis] = *found;
  }
  return columns;
}

/// The value in those columns; nothing if any of them is empty.
template <int D>
std::optional<Eigen::Matrix<double, D, 1>> read_vector(const NumberTable& table,
                                                       const AxisColumns<D>& columns) {
  Eigen::Matrix<double, D, 1> value;
  for (int axis = 0; axis < D; ++axis) {
    const auto cell = table.cell(columns[axis]);
    if (!cell) return std::nullopt;
    value[axis] = *cell;
  }
  return value;
}

/// Running means of what --json and the remark at the end report.
class Errors {
 public:
  void add_innovation(double size) {
    innovations_ += size;
    ++updates_;
  }
  void add_error(double squared) {
    squared_errors_ += squared;
    ++rows_with_truth_;
  }
  void add_measurement_error(double squared) {
    squared_measurement_errors_ += squared;
    ++measurements_with_truth_;
  }
  void add_row() { ++rows_; }

  nlohmann::ordered_json json() const {
    const auto mean = [](double sum, std::int64_t n) {
      return n == 0 ? std::optional<double>() : sum / static_cast<double>(n);
    };
    const auto number = [](std::optional<double> value, bool root) {
      if (!value || !std::isfinite(*value)) return nlohmann::ordered_json();
      return nlohmann::ordered_json(root ? std::sqrt(*value) : *value);
    };
    return {{"n", rows_},
            {"rmse", number(mean(squared_errors_, rows_with_truth_), true)},
            {"mai", number(mean(innovations_, updates_), false)},
            {"measurement_rmse",
             number(mean(squared_measurement_errors_, measurements_with_truth_), true)}};
  }

  bool knows_truth() const { return rows_with_truth_ > 0; }

 private:
  double innovations_ = 0.0, squared_errors_ = 0.0, squared_measurement_errors_ = 0.0;
  std::int64_t rows_ = 0, updates_ = 0, rows_with_truth_ = 0, measurements_with_truth_ = 0;
};

/// CSV on standard output, written in large blocks.
class Output {
 public:
  template <int D>
  void header(bool with_acceleration) {
    text_ += "k,t";
    std::vector<const char*> names = {"z", "x_pred", "dx_pred", "residual", "x", "dx"};
    if (with_acceleration) names.insert(names.end(), {"ddx_pred", "ddx"});
    for (const char* name : names) {
      for (int axis = 0; axis < D; ++axis)
        text_ += fmt::format(",{}{}", name, D == 1 ? "" : kAxes[axis]);
    }
    text_ += '\n';
  }

  void integer(std::int64_t value) { fmt::format_to(std::back_inserter(text_), "{}", value); }
  void number(double value) {
    text_ += ',';
    append_number(text_, value);
  }
  template <int D>
  void vector(const Eigen::Matrix<double, D, 1>& value) {
    for (int axis = 0; axis < D; ++axis) number(value[axis]);
  }
  template <int D>
  void vector(const std::optional<Eigen::Matrix<double, D, 1>>& value) {
    if (value) return vector<D>(*value);
    text_.append(D, ',');
  }
  void end_row() {
    text_ += '\n';
    if (text_.size() >= kOutputBlock) flush();
  }
  void flush() {
    if (std::fwrite(text_.data(), 1, text_.size(), stdout) != text_.size()) {
      throw WriteError("standard output cannot be written");
    }
    text_.clear();
  }

 private:
  std::string text_;
};

template <int D>
class Session {
 public:
  Session(NumberTable& table, const FilterCommandOptions& options)
      : table_(table),
        options_(options),
        filter_(options, Kinematics<D>{parse_vector<D>(options.x0, "--x0"),
                                       parse_vector<D>(options.dx0, "--dx0"),
                                       parse_vector<D>(options.ddx0, "--ddx0")}),
        z_(*find_columns<D>(table, "z")),
        truth_(find_columns<D>(table, "truth")),
        g_(table.column("g")),
        h_(table.column("h")),
        k_(table.column("k")),
        dt_(table.column("dt")) {
    if (options.t_column.empty()) return;
    t_ = table.column(options.t_column);
    if (!t_) table.fail(fmt::format("there is no column '{}'", printable(options.t_column)));
  }

  void run(bool quiet) {
    if (!options_.json) output_.header<D>(filter_.order() == 2);
    for (std::int64_t row = 1; table_.next(); ++row) {
      if (row % 4096 == 0) stop_if_interrupted();
      process(row);
    }
    if (options_.json) {
      fmt::print("{}\n", errors_.json().dump());
    } else {
      output_.flush();
      if (!quiet && errors_.knows_truth()) fmt::print(stderr, "{}\n", errors_.json().dump());
    }
    const Refusals refusals = filter_.refusals();
    if (!quiet && refusals.times + refusals.measurements > 0) {
      fmt::print(stderr,
                 "ghtrack: warning: refused {} time steps that are not positive and finite and {} "
                 "measurements that are not finite\n",
                 refusals.times, refusals.measurements);
    }
  }

 private:
  using Vector = Eigen::Matrix<double, D, 1>;

  std::optional<double> cell(const std::optional<std::size_t>& column) const {
    return column ? table_.cell(*column) : std::nullopt;
  }

  /// Goes on to the time of the row. @returns the time since the row before
  double elapse(std::int64_t row) {
    if (t_) {
      const auto t = table_.cell(*t_);
      if (!t) table_.fail("the time is missing");
      const double dt = row == 1 ? options_.dt : *t - time_;
      if (row == 1 || dt > 0.0) time_ = *t;
      return dt;
    }
    const auto own = cell(dt_);
    even_ = even_ && !own;
    const double dt = own.value_or(options_.dt);
    if (even_) {
      time_ = static_cast<double>(row) * options_.dt;
    } else if (dt > 0.0 && std::isfinite(dt)) {
      time_ += dt;
    }
    return dt;
  }

  void process(std::int64_t row) {
    const double dt = elapse(row);
    const bool moved = filter_.predict(dt);
    const Kinematics<D> prior = filter_.estimate();
    const std::optional<Vector> z = read_vector<D>(table_, z_);
    std::optional<Vector> residual;
    if (z && moved) {
      const bool used = filter_.update(*z, cell(g_), cell(h_), cell(k_));
      if (used) residual = *z - prior.position;
    }
    const Kinematics<D>& estimate = filter_.estimate();
    account(z, residual, estimate);
    if (options_.json) return;
    output_.integer(row);
    output_.number(time_);
    output_.template vector<D>(z);
    output_.template vector<D>(prior.position);
    output_.template vector<D>(prior.velocity);
    output_.template vector<D>(residual);
    output_.template vector<D>(estimate.position);
    output_.template vector<D>(estimate.velocity);
    if (filter_.order() == 2) {
      output_.template vector<D>(prior.acceleration);
      output_.template vector<D>(estimate.acceleration);
    }
    output_.end_row();
  }

  void account(const std::optional<Vector>& z, const std::optional<Vector>& residual,
               const Kinematics<D>& estimate) {
    errors_.add_row();
    if (residual) errors_.add_innovation(residual->norm());
    if (!truth_) return;
    const std::optional<Vector> truth = read_vector<D>(table_, *truth_);
    if (!truth) return;
    errors_.add_error((estimate.position - *truth).squaredNorm());
    if (z) errors_.add_measurement_error((*z - *truth).squaredNorm());
  }

  NumberTable& table_;
  const FilterCommandOptions& options_;
  SeriesFilterEngine<D> filter_;
  AxisColumns<D> z_;
  std::optional<AxisColumns<D>> truth_;
  std::optional<std::size_t> g_, h_, k_, dt_, t_;
  double time_ = 0.0;
  bool even_ = true;  // no row has had a step of its own
  Errors errors_;
  Output output_;
};

}  // namespace

int filter(const FilterCommandOptions& options, const Manners& manners) {
  NumberTable table(options.file);
  warn_of_unstable_gains(options, manners.quiet);
  if (find_columns<1>(table, "z")) {
    Session<1>(table, options).run(manners.quiet);
  } else if (find_columns<3>(table, "z")) {
    Session<3>(table, options).run(manners.quiet);
  } else if (find_columns<2>(table, "z")) {
    Session<2>(table, options).run(manners.quiet);
  } else {
    table.fail("there is no column z, nor zx,zy[,zz]; known are the columns " +
               printable(fmt::format("{}", fmt::join(table.columns(), ", "))));
  }
  return 0;
}

}  // namespace ghtrack::cli
