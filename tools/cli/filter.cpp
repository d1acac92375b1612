// `ghtrack filter`: a series of measurements through one filter, row by row.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/commands.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/number_table.hpp"
#include "tools/cli/series_filter.hpp"
#include "tools/cli/series_rows.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/record/errors.hpp"
#include "tracker/filters/gains/analysis.hpp"

namespace ghtrack::cli {
namespace {

constexpr std::size_t kOutputBlock = std::size_t{1} << 16U;
constexpr std::array<const char*, 3> kAxes = {"_x", "_y", "_z"};

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
  void header(std::size_t axes, bool with_acceleration) {
    text_ += "k,t";
    std::vector<const char*> names = {"z", "x_pred", "dx_pred", "residual", "x", "dx"};
    if (with_acceleration) names.insert(names.end(), {"ddx_pred", "ddx"});
    for (const char* name : names) {
      for (std::size_t axis = 0; axis < axes; ++axis)
        text_ += fmt::format(",{}{}", name, axes == 1 ? "" : kAxes[axis]);
    }
    text_ += '\n';
  }

  void integer(std::int64_t value) { fmt::format_to(std::back_inserter(text_), "{}", value); }
  void number(double value) {
    text_ += ',';
    append_number(text_, value);
  }
  void empty() { text_ += ','; }
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

/// Carries a row's values, all of one kind, axis by axis.
using Axes = std::vector<double>;

class Session {
 public:
  Session(NumberTable& table, const FilterCommandOptions& options, bool quiet)
      : options_(options),
        quiet_(quiet),
        rows_(table, options.t_column),
        plan_(options, rows_.axes(), rows_.has_times()),
        step_(options.dt ? *options.dt : rows_.typical_step().value_or(1.0)),
        filter_(options, plan_, step_) {
    if (options.period && !(*options.period > 0.0 && std::isfinite(*options.period))) {
      throw UsageError(fmt::format("filter: --period is {}; it must be positive", *options.period));
    }
  }

  void run() {
    warn_of_unstable_gains();
    if (!options_.json) output_.header(rows_.axes(), plan_.order == 2);
    while (const std::optional<MeasuredRow> row = rows_.next()) {
      if (row->number % 4096 == 0) stop_if_interrupted();
      process(*row);
      say(rows_.take_remarks());
    }
    say(rows_.take_remarks());
    if (options_.json) {
      fmt::print("{}\n", errors_.json().dump());
    } else {
      output_.flush();
      if (!quiet_ && errors_.knows_truth()) fmt::print(stderr, "{}\n", errors_.json().dump());
    }
    const Refusals refusals = filter_.refusals();
    if (!quiet_ && refusals.times + refusals.measurements > 0) {
      fmt::print(stderr,
                 "ghtrack: warning: refused {} time steps that are not positive and finite and {} "
                 "measurements that are not finite\n",
                 refusals.times, refusals.measurements);
    }
  }

 private:
  /// What the filter says of one moment, and what it was told.
  struct Moment {
    std::vector<Kinematics<1>> prior, posterior;
    std::optional<Axes> z, residual;
  };

  void warn_of_unstable_gains() const {
    const auto violated = filter_.gains() ? violated_inequality(*filter_.gains()) : std::nullopt;
    if (!violated || quiet_) return;
    fmt::print(stderr, "ghtrack: warning: these gains are unstable: {} does not hold\n", *violated);
  }

  void say(const std::vector<std::string>& remarks) const {
    if (quiet_) return;
    for (const std::string& remark : remarks) fmt::print(stderr, "{}\n", remark);
  }

  /// Goes on to the time of the row. @returns the time since the row before [s]
  double elapse(const MeasuredRow& row) {
    if (row.t) {
      const double dt = is_first_ ? step_ : *row.t - time_;
      is_first_ = false;
      time_ = *row.t;
      return dt;
    }
    even_ = even_ && !row.dt;
    const double dt = row.dt.value_or(step_);
    if (even_) {
      time_ = static_cast<double>(row.number) * step_;
    } else if (dt > 0.0 && std::isfinite(dt)) {
      time_ += dt;
    }
    return dt;
  }

  std::vector<Kinematics<1>> estimates() const {
    std::vector<Kinematics<1>> all;
    for (std::size_t axis = 0; axis < rows_.axes(); ++axis) all.push_back(filter_.estimate(axis));
    return all;
  }

  /// The same angle on the turn that is nearest to `to`; without --period the value itself.
  double near(double value, double to) const {
    return options_.period ? to + std::remainder(value - to, *options_.period) : value;
  }

  void process(const MeasuredRow& row) {
    const double dt = elapse(row);
    Moment moment;
    if (row.is_measured()) {
      moment.z.emplace();
      for (const auto& value : row.z) moment.z->push_back(*value);
    }
    if (filter_.is_started()) {
      step(row, dt, moment);
    } else if (moment.z) {
      start(row, moment);
    }
    account(row, moment);
    if (!options_.json) write(row, moment);
  }

  void start(const MeasuredRow& row, Moment& moment) {
    filter_.start(row);
    moment.prior = moment.posterior = estimates();
    if (quiet_) return;
    fmt::print(stderr,
               "ghtrack: there is no --x0, so the filter starts at the measurement of row {}\n",
               row.number);
  }

  void step(const MeasuredRow& row, double dt, Moment& moment) {
    // A second measurement at the same time corrects without a step.
    const bool moved = (row.t && dt == 0.0) || filter_.predict(dt);
    moment.prior = estimates();
    if (moment.z && moved) {
      Axes z = *moment.z;
      for (std::size_t i = 0; i < z.size(); ++i) z[i] = near(z[i], moment.prior[i].position[0]);
      if (filter_.update(z, row)) {
        moment.residual.emplace();
        for (std::size_t i = 0; i < z.size(); ++i) {
          moment.residual->push_back(z[i] - moment.prior[i].position[0]);
        }
      }
    }
    moment.posterior = estimates();
  }

  void write(const MeasuredRow& row, const Moment& moment) {
    const auto kinematics = [&](const std::vector<Kinematics<1>>& all, auto&& part) {
      for (std::size_t i = 0; i < rows_.axes(); ++i) {
        all.empty() ? output_.empty() : output_.number(part(all[i], i));
      }
    };
    const auto axes = [&](const std::optional<Axes>& values) {
      for (std::size_t i = 0; i < rows_.axes(); ++i) {
        values ? output_.number((*values)[i]) : output_.empty();
      }
    };
    // Angles are written on the turn of what was measured.
    const auto position = [&](const Kinematics<1>& state, std::size_t i) {
      return near(state.position[0], moment.z ? (*moment.z)[i] : state.position[0]);
    };
    const auto velocity = [](const Kinematics<1>& state, std::size_t) { return state.velocity[0]; };
    const auto acceleration = [](const Kinematics<1>& state, std::size_t) {
      return state.acceleration[0];
    };
    output_.integer(row.number);
    output_.number(time_);
    axes(moment.z);
    kinematics(moment.prior, position);
    kinematics(moment.prior, velocity);
    axes(moment.residual);
    kinematics(moment.posterior, position);
    kinematics(moment.posterior, velocity);
    if (plan_.order == 2) {
      kinematics(moment.prior, acceleration);
      kinematics(moment.posterior, acceleration);
    }
    output_.end_row();
  }

  void account(const MeasuredRow& row, const Moment& moment) {
    const auto length = [](const Axes& values) {
      double squares = 0.0;
      for (const double value : values) squares += value * value;
      return std::sqrt(squares);
    };
    errors_.add_row();
    if (moment.residual) errors_.add_innovation(length(*moment.residual));
    Axes error, measurement_error;
    for (std::size_t i = 0; i < row.truth.size(); ++i) {
      if (!row.truth[i]) return;
      const double truth = *row.truth[i];
      if (!moment.posterior.empty()) {
        error.push_back(near(moment.posterior[i].position[0], truth) - truth);
      }
      if (moment.z) measurement_error.push_back(near((*moment.z)[i], truth) - truth);
    }
    if (!error.empty()) errors_.add_error(std::pow(length(error), 2));
    if (!measurement_error.empty()) {
      errors_.add_measurement_error(std::pow(length(measurement_error), 2));
    }
  }

  const FilterCommandOptions& options_;
  bool quiet_;
  SeriesRows rows_;
  FilterPlan plan_;
  double step_;  // nominal, between rows [s]
  AxisFilters filter_;
  double time_ = 0.0;
  bool is_first_ = true;
  bool even_ = true;  // no row has had a step of its own
  Errors errors_;
  Output output_;
};

}  // namespace

int filter(const FilterCommandOptions& options, const Manners& manners) {
  NumberTable table(options.file);
  Session(table, options, manners.quiet).run();
  return 0;
}

}  // namespace ghtrack::cli
