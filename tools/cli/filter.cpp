// `ghtrack filter`: a series of measurements through one filter, row by row.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/diagnostic.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/data_source.hpp"
#include "tools/cli/interruption.hpp"
#include "tools/cli/messages.hpp"
#include "tools/cli/series_filter.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/data/series_reader.hpp"
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
  void header(std::size_t axes, bool with_acceleration, const std::vector<std::string>& models) {
    text_ += "k,t";
    std::vector<const char*> names = {"z", "x_pred", "dx_pred", "residual", "x", "dx"};
    if (with_acceleration) names.insert(names.end(), {"ddx_pred", "ddx"});
    for (const char* name : names) {
      for (std::size_t axis = 0; axis < axes; ++axis)
        text_ += fmt::format(",{}{}", name, axes == 1 ? "" : kAxes[axis]);
    }
    for (const std::string& model : models) {
      for (std::size_t axis = 0; axis < axes; ++axis) {
        text_ += ',';
        append_text(text_, fmt::format("p_{}{}", model, axes == 1 ? "" : kAxes[axis]));
      }
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

class Session {
 public:
  Session(SeriesReader& rows, const FilterCommandOptions& options, const Manners& manners)
      : options_(options),
        manners_(manners),
        rows_(rows),
        plan_(options, rows_.axes(), rows_.has_times()),
        step_(options.dt ? *options.dt : rows_.typical_step().value_or(1.0)),
        filter_(options, plan_, step_) {
    if (options.period && !(*options.period > 0.0 && std::isfinite(*options.period))) {
      throw UsageError(fmt::format("filter: --period is {}; it must be positive", *options.period));
    }
  }

  void run() {
    tell_of_unused_options();
    warn_of_unstable_gains();
    if (!options_.json) output_.header(rows_.axes(), plan_.order == 2, plan_.models);
    while (const std::optional<MeasuredRow> row = rows_.next()) {
      if (row->number % 4096 == 0) stop_if_interrupted();
      process(*row);
      say(rows_.take_warnings());
    }
    say(rows_.take_warnings());
    tell_what_was_left_out(rows_.left_out(), rows_.remarks(), manners_);
    if (options_.json) {
      fmt::print("{}\n", errors_.json().dump());
    } else {
      output_.flush();
      if (!manners_.quiet && errors_.knows_truth()) tell("{}", errors_.json().dump());
    }
    const Refusals refusals = filter_.refusals();
    if (!manners_.quiet && refusals.times + refusals.measurements > 0) {
      tell(
          "ghtrack: warning: refused {} time steps that are not positive and finite and {} "
          "measurements that are not finite or have no finite estimate",
          refusals.times, refusals.measurements);
    }
  }

 private:
  /// What the filter says of one moment, and what it was told.
  struct Moment {
    std::vector<Kinematics<1>> prior, posterior;
    std::optional<AxisVector> z, residual;
    std::vector<std::vector<double>> probabilities;  // of the models, by axis
  };

  void warn_of_unstable_gains() const {
    const auto violated = filter_.gains() ? violated_inequality(*filter_.gains()) : std::nullopt;
    if (!violated || manners_.quiet) return;
    tell("ghtrack: warning: these gains are unstable: {} does not hold", *violated);
  }

  void tell_of_unused_options() const {
    const std::vector<std::string_view> unused = unused_options(options_);
    if (unused.empty() || manners_.quiet) return;
    tell("ghtrack: warning: {} {} nothing with --filter {}", fmt::join(unused, ", "),
         unused.size() == 1 ? "does" : "do", printable(options_.filter));
  }

  void say(const std::vector<std::string>& warnings) const {
    if (manners_.quiet) return;
    for (const std::string& warning : warnings) tell("{}", warning);
  }

  /// Goes on to the time of the row. @returns the time since the row before [s]
  double elapse(const MeasuredRow& row) {
    if (row.time) {
      const double dt = is_first_ ? step_ : *row.time - time_;
      is_first_ = false;
      time_ = *row.time;
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

  AxisVector near(const AxisVector& values, const AxisVector& to) const {
    AxisVector result = values;
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = near(values[i], to[i]);
    return result;
  }

  static AxisVector positions(const std::vector<Kinematics<1>>& states) {
    AxisVector result(static_cast<Eigen::Index>(states.size()));
    for (std::size_t i = 0; i < states.size(); ++i) {
      result[static_cast<Eigen::Index>(i)] = states[i].position[0];
    }
    return result;
  }

  void process(const MeasuredRow& row) {
    const double dt = elapse(row);
    Moment moment;
    moment.z = row.z;
    if (filter_.is_started()) {
      step(row, dt, moment);
    } else if (moment.z) {
      start(row, moment);
    }
    for (std::size_t i = 0; i < rows_.axes() && filter_.is_started(); ++i) {
      moment.probabilities.push_back(filter_.model_probabilities(i));
    }
    account(row, moment);
    if (!options_.json) write(row, moment);
  }

  void start(const MeasuredRow& row, Moment& moment) {
    filter_.start(row);
    moment.prior = moment.posterior = estimates();
    if (manners_.quiet) return;
    const bool guesses_rate = !plan_.config && options_.dx0.empty();
    tell("ghtrack: there is no --x0, so the filter starts at the measurement of row {}{}",
         row.number,
         guesses_rate ? fmt::format(", at a rate of 0 with variance {:g} (--dx0, --p0)",
                                    options_.p0.value_or(1.0))
                      : std::string());
  }

  void step(const MeasuredRow& row, double dt, Moment& moment) {
    // A second measurement at the same time corrects without a step.
    const bool moved = (row.time && dt == 0.0) || filter_.predict(dt);
    moment.prior = estimates();
    if (moment.z && moved) {
      const AxisVector prior = positions(moment.prior);
      const AxisVector z = near(*moment.z, prior);
      if (filter_.update(z, row)) moment.residual = filter_.residual();
    }
    moment.posterior = estimates();
  }

  void write(const MeasuredRow& row, const Moment& moment) {
    const auto kinematics = [&](const std::vector<Kinematics<1>>& all, auto&& part) {
      for (std::size_t i = 0; i < rows_.axes(); ++i) {
        all.empty() ? output_.empty() : output_.number(part(all[i], i));
      }
    };
    const auto axes = [&](const std::optional<AxisVector>& values) {
      for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(rows_.axes()); ++i) {
        values ? output_.number((*values)[i]) : output_.empty();
      }
    };
    // Angles are written on the turn of what was measured.
    const auto position = [&](const Kinematics<1>& state, std::size_t i) {
      return near(state.position[0],
                  moment.z ? (*moment.z)[static_cast<Eigen::Index>(i)] : state.position[0]);
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
    for (std::size_t model = 0; model < plan_.models.size(); ++model) {
      for (std::size_t i = 0; i < rows_.axes(); ++i) {
        moment.probabilities.empty() ? output_.empty()
                                     : output_.number(moment.probabilities[i][model]);
      }
    }
    output_.end_row();
  }

  void account(const MeasuredRow& row, const Moment& moment) {
    errors_.add_row();
    if (moment.residual) errors_.add_innovation(moment.residual->norm());
    if (!row.truth) return;
    const auto ring = plan_.config ? places_on_ring(*plan_.config) : std::nullopt;
    const auto squared_error = [&](const AxisVector& position) {
      AxisVector error = near(position, *row.truth) - *row.truth;
      if (ring) error[0] = std::remainder(error[0], *ring);
      return error.squaredNorm();
    };
    if (!moment.posterior.empty()) errors_.add_error(squared_error(positions(moment.posterior)));
    const bool is_comparable = !plan_.config || measures_state(*plan_.config);
    if (moment.z && is_comparable) errors_.add_measurement_error(squared_error(*moment.z));
  }

  const FilterCommandOptions& options_;
  const Manners& manners_;
  SeriesReader& rows_;
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
  ReadOptions reading = read_options(options.data);
  reading.time_column = options.t_column;
  SeriesReader rows(options.file, reading,
                    options.dt ? SeriesTimes::kIfAsked : SeriesTimes::kIfThere);
  const bool times_were_found = rows.has_times() && options.t_column.empty();
  if (!manners.quiet && (times_were_found || !rows.is_plain())) {
    tell("ghtrack: {}", rows.understood());
  }
  Session(rows, options, manners).run();
  return 0;
}

}  // namespace ghtrack::cli
