#include "tools/experiment/tuning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "scenes/schema/descriptions.hpp"
#include "scenes/schema/value_json.hpp"
#include "tools/experiment/analysis.hpp"
#include "tools/experiment/gain_search.hpp"
#include "tools/experiment/labelled_objects.hpp"
#include "tools/experiment/parallel.hpp"
#include "tools/experiment/statistics.hpp"
#include "tools/experiment/trial.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostScans = 200'000;  // that one evaluation goes through, of all regimes

/// So many digits are printed, and so many are judged.
double rounded(double value) { return std::stod(fmt::format("{:.4g}", value)); }

/// {gh: {g: …, h: …}}
FilterConfig config_of(const Gains& gains) {
  if (gains.order == 0) {
    return Order0Config{.design = gain_design::Manual<0>{rounded(gains.g), 0.0, 0.0}};
  }
  if (gains.order == 1) {
    return GhConfig{.design = gain_design::Manual<1>{rounded(gains.g), rounded(gains.h), 0.0}};
  }
  return GhkConfig{
      .design = gain_design::Manual<2>{rounded(gains.g), rounded(gains.h), rounded(gains.k)}};
}

/// {gh: {design: tracking-index, process_noise: …}}
template <int Order>
FilterConfig tracking_index_config(double process_noise) {
  gain_design::TrackingIndex<Order> design;
  design.process_noise = rounded(process_noise);
  return GainFilterConfig<Order>{.design = design};
}

/// {kalman-cv: {process_noise: …}}
template <int Order>
FilterConfig kalman_config(double process_noise) {
  process::PiecewiseConstant noise;
  noise.process_noise = rounded(process_noise);
  return KalmanConfig<Order>{.model = noise};
}

/// Without what a scene need not say.
std::string text_of(const FilterConfig& config) {
  using Json = nlohmann::ordered_json;
  const schema::Type& type = schema::type_of<FilterConfig>();
  Json said = schema::to_json(type, &config);
  const FilterConfig plain = std::visit(
      [](const auto& chosen) { return FilterConfig(std::decay_t<decltype(chosen)>{}); }, config);
  const Json by_default = schema::to_json(type, &plain);
  if (said.is_object() && said.size() == 1 && said.begin()->is_object()) {
    const std::string kind = said.begin().key();
    Json short_one = Json::object();
    for (const auto& [key, value] : said.at(kind).items()) {
      const bool is_default = by_default.contains(kind) && by_default.at(kind).contains(key) &&
                              by_default.at(kind).at(key) == value;
      if (!is_default) short_one[key] = value;
    }
    said = Json{{kind, std::move(short_one)}};
  }
  std::string text;
  for (const char c : said.dump()) {
    if (c == '"') continue;
    text += c;
    if (c == ',' || c == ':') text += ' ';
  }
  return text;
}

/// A filter that is to be judged.
struct Candidate {
  std::string origin;
  TrackerDesign design;
  std::optional<FilterConfig> config;  // absent: several of the scene's side by side
};

/// Tunes and judges one regime.
class RegimeTuner {
 public:
  RegimeTuner(const Trial& trial, const std::string& regime, LabelledRuns training,
              LabelledRuns judging, const TuningOptions& options)
      : trial_(trial),
        sensor_(best_sensor(trial.scene().sensors)),
        regime_(regime),
        training_(std::move(training)),
        judging_(std::move(judging)),
        options_(options) {}

  TunedRegime result(const SubjectTheory& theory) const {
    TunedRegime tuned;
    tuned.regime = regime_;
    tuned.acceleration = std::sqrt(0.5 * theory.square_acceleration);
    tuned.correlation_time = correlation_time(theory);
    tuned.tracking_index = tracking_index(tuned.acceleration, sensor_.sigma, sensor_.period);
    tuned.hindsight = theory.hindsight;

    std::vector<Candidate> candidates;
    add_scene(candidates);
    add_tuned(candidates);
    add_designs(theory, candidates);
    std::vector<std::vector<double>> rmse;
    for (const Candidate& candidate : candidates) {
      rmse.push_back(rmse_of_runs(candidate.design, judging_));
    }
    tuned.recommended = recommended(candidates, rmse);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      tuned.judged.push_back(judge(candidates[i], rmse[i], rmse[tuned.recommended]));
    }
    tuned.best =
        steady_gains(candidates[tuned.recommended].design.filter_for(regime_, 0)).value_or(Gains{});
    return tuned;
  }

 private:
  /// τ of an acceleration whose correlation falls as e^(−t/τ), from that of neighbouring scans.
  double correlation_time(const SubjectTheory& theory) const {
    const double rho = theory.square_acceleration > 0.0
                           ? theory.square_autocorrelation / theory.square_acceleration
                           : 0.0;
    if (!(rho > 0.0)) return 0.0;
    const double longest = trial_.scene().duration;
    return rho < 1.0 ? std::min(longest, -sensor_.period / std::log(rho)) : longest;
  }

  TrackerDesign design_of(const FilterConfig& filter) const {
    TrackerConfig config = trial_.scene().tracker;
    config.association = Association::kNearestGlobal;  // filters do not depend on it
    config.filters = {{std::string(TrackerConfig::kDefaultFilter), filter}};
    return {std::move(config), traits_of(trial_.scene().sensors)};
  }

  SquaredErrors errors(const TrackerDesign& design, const LabelledObject& object) const {
    return measured_errors(design.filter_for(regime_, object.scans.front().sensor), object);
  }

  double pooled_rmse(const TrackerDesign& design, const LabelledRuns& runs) const {
    SquaredErrors sum;
    for (const std::vector<LabelledObject>& run : runs) {
      for (const LabelledObject& object : run) sum += errors(design, object);
    }
    return sum.position.root().value_or(std::numeric_limits<double>::infinity());
  }

  /// RMSE of each run; NaN where nothing was seen.
  std::vector<double> rmse_of_runs(const TrackerDesign& design, const LabelledRuns& runs) const {
    std::vector<double> all;
    for (const std::vector<LabelledObject>& run : runs) {
      SquaredErrors sum;
      for (const LabelledObject& object : run) sum += errors(design, object);
      all.push_back(or_nan(sum.position.root()));
    }
    return all;
  }

  double training_cost(const FilterConfig& config) const {
    trial_.step();
    const double rmse = pooled_rmse(design_of(config), training_);
    return std::isfinite(rmse) ? rmse : std::numeric_limits<double>::infinity();
  }

  void add(const std::string& origin, const FilterConfig& config,
           std::vector<Candidate>& candidates) const {
    candidates.push_back({origin, design_of(config), config});
  }

  /// What the scene uses for the regime, and what it compares.
  void add_scene(std::vector<Candidate>& candidates) const {
    TrackerConfig config = trial_.scene().tracker;
    config.association = Association::kNearestGlobal;
    std::optional<FilterConfig> own;
    for (const std::string& label : {regime_, std::string(TrackerConfig::kDefaultFilter)}) {
      const auto found = config.filters.find(label);
      if (!own && found != config.filters.end()) own = found->second;
    }
    candidates.push_back(
        {"scene", TrackerDesign(std::move(config), traits_of(trial_.scene().sensors)), own});
    for (const auto& [name, filter] : trial_.scene().compare.filters) add(name, filter, candidates);
  }

  void add_tuned(std::vector<Candidate>& candidates) const {
    for (const int order : options_.orders) {
      const GainFamily family =
          options_.rule ? *gains_of_rule(*options_.rule, order) : stable_gains(order);
      const FoundGains found =
          least_cost(family, [&](const Gains& gains) { return training_cost(config_of(gains)); });
      add("tuned", config_of(found.gains), candidates);
    }
    if (options_.rule || options_.orders.size() < 2) return;
    const FoundNumber g = least_cost_of_number(
        1e-3, 1.5, 9, 6, [&](double at) { return training_cost(config_of(Gains::of_g(at))); });
    add("tuned", config_of(Gains::of_g(g.at)), candidates);
    add_tuned_noise(tracking_index_config<1>, 1, candidates);
    add_tuned_noise(tracking_index_config<2>, 2, candidates);
    add_tuned_noise(kalman_config<1>, 1, candidates);
    add_tuned_noise(kalman_config<2>, 2, candidates);
    add("models", ImmConfig{}, candidates);
  }

  /// Filters with the best process noise, over tracking indices from 10^-4 to 100.
  void add_tuned_noise(FilterConfig (*config)(double), int order,
                       std::vector<Candidate>& candidates) const {
    const double unit =
        intensity_of_index(ProcessModel::kPiecewiseConstant, 1.0, sensor_.sigma, sensor_.period);
    const FoundNumber noise =
        least_cost_of_number(1e-4 * unit, 1e2 * unit, order == 1 ? 10 : 8, 6,
                             [&](double at) { return training_cost(config(at)); });
    add("tuned", config(noise.at), candidates);
  }

  /// Gains by rule, from the regime's own statistics: Kalata's for its accelerations, and the other
  /// rules' at the same g. An acceleration a that lasts for τ disturbs a filter as white noise does
  /// of a √(2τ / T) at each step.
  void add_designs(const SubjectTheory& theory, std::vector<Candidate>& candidates) const {
    const double lasting =
        std::sqrt(std::max(1.0, 2.0 * correlation_time(theory) / sensor_.period));
    for (const int order : options_.orders) {
      const double jump = order == 1 ? lasting * std::sqrt(0.5 * theory.square_acceleration)
                                     : sensor_.period * std::sqrt(0.5 * theory.square_jerk);
      const double index =
          std::clamp(tracking_index(jump, sensor_.sigma, sensor_.period), 1e-5, 1e3);
      const Gains kalata = tracking_index_gains(order, index);
      const double theta = order == 1 ? std::sqrt(1.0 - kalata.g) : std::cbrt(1.0 - kalata.g);
      add("tracking-index", config_of(kalata), candidates);
      add("benedict-bordner",
          config_of(order == 1 ? benedict_bordner_gains(kalata.g)
                               : third_order_benedict_bordner_gains(kalata.g)),
          candidates);
      add("critical-damping", config_of(fading_memory_gains(order, theta)), candidates);
    }
  }

  /// The least error in judging. The scene's own filter, the first one, stays unless the best one
  /// is better by more than the interval of their difference.
  std::size_t recommended(const std::vector<Candidate>& candidates,
                          const std::vector<std::vector<double>>& rmse) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double error = mean_of(rmse[i], Average::kRootMeanSquare).mean;
      if (!candidates[i].config || !(error < least)) continue;
      least = error;
      best = i;
    }
    // The best of so many looks better than it is: each is asked for its share of the 0.05.
    const double confidence = 1.0 - 0.05 / static_cast<double>(candidates.size());
    const PairedDifference worse =
        paired_difference(rmse[0], rmse[best], Average::kRootMeanSquare, confidence);
    const bool is_better = worse.interval && worse.interval->low > 0.0;
    return candidates[0].config && !is_better ? 0 : best;
  }

  JudgedGains judge(const Candidate& candidate, const std::vector<double>& rmse,
                    const std::vector<double>& winner) const {
    const Filter& filter = candidate.design.filter_for(regime_, 0);
    const SampleMean mean = mean_of(rmse, Average::kRootMeanSquare);
    const PairedDifference difference =
        paired_difference(rmse, winner, Average::kRootMeanSquare, 0.95);
    const bool several = std::holds_alternative<MultipleModelFilter<2>>(filter);
    return {.origin = candidate.origin,
            .filter = several ? "multiple-model" : std::string(name(filter)),
            .gains = several ? "" : gains_text(filter),
            .trained_rmse = pooled_rmse(candidate.design, training_),
            .rmse = mean.mean,
            .ci95 = mean.ci95,
            .difference = difference.value,
            .difference_ci95 = difference.interval,
            .text = candidate.config ? text_of(*candidate.config) : ""};
  }

  const Trial& trial_;
  SensorTraits sensor_;
  std::string regime_;
  LabelledRuns training_;
  LabelledRuns judging_;
  const TuningOptions& options_;
};

/// Tunes filters for all objects of a scene together.
class AllTuner {
 public:
  AllTuner(const Trial& trial, const LabelledRuns& runs) : trial_(trial), runs_(runs) {
    const SensorTraits best = best_sensor(trial.scene().sensors);
    unit_ = intensity_of_index(ProcessModel::kPiecewiseConstant, 1.0, best.sigma, best.period);
  }

  FilterConfig gains(int order) const {
    ObjectsOfRuns objects;
    for (const std::vector<LabelledObject>& run : runs_) {
      for (const LabelledObject& object : run) objects.push_back(&object);
    }
    const std::optional<Gains> best = best_gains(objects, trial_.scene().sensors, trial_.scoring(),
                                                 order, [this] { trial_.step(); });
    if (best) return config_of(*best);
    return config_of(least_cost(stable_gains(order), [&](const Gains& gains) {
                       return cost(config_of(gains));
                     }).gains);
  }

  struct Kalman {
    FilterConfig config;
    double process_noise = 0.0;
    double cost = 0.0;
    int order = 1;
  };
  Kalman kalman() const {
    const Kalman cv = kalman_of(kalman_config<1>, 1);
    const Kalman ca = kalman_of(kalman_config<2>, 2);
    return cv.cost < ca.cost ? cv : ca;
  }

  /// Two Kalman filters like the best one, a calmer and a livelier one.
  FilterConfig interacting(const Kalman& best) const {
    FilterConfig chosen = ImmConfig{};
    double least = cost(chosen);
    for (const double ratio : {2.0, 5.0, 20.0}) {
      for (const double switching : {0.02, 0.1}) {
        ImmConfig config;
        config.switching = switching;
        for (const auto& [name, noise] : {std::pair{"calm", best.process_noise / ratio},
                                          {"lively", best.process_noise * ratio}}) {
          config.filters[name] = best.order == 1 ? single<1>(noise) : single<2>(noise);
        }
        const double found = cost(config);
        if (!(found < least)) continue;
        least = found;
        chosen = config;
      }
    }
    return chosen;
  }

 private:
  template <int Order>
  static SingleFilterConfig single(double process_noise) {
    return std::get<KalmanConfig<Order>>(kalman_config<Order>(process_noise));
  }

  Kalman kalman_of(FilterConfig (*config)(double), int order) const {
    const FoundNumber noise = least_cost_of_number(1e-5 * unit_, 1e3 * unit_, 12, 8,
                                                   [&](double at) { return cost(config(at)); });
    return {config(noise.at), noise.at, noise.cost, order};
  }

  double cost(const FilterConfig& filter) const {
    trial_.step();
    TrackerConfig config = trial_.scene().tracker;
    config.association = Association::kNearestGlobal;  // filters do not depend on it
    config.filters = {{std::string(TrackerConfig::kDefaultFilter), filter}};
    const TrackerDesign design(std::move(config), traits_of(trial_.scene().sensors));
    SquaredErrors sum;
    for (const std::vector<LabelledObject>& run : runs_) {
      for (const LabelledObject& object : run) {
        sum += measured_errors(design.filter_for("", object.scans.front().sensor), object);
      }
    }
    const double rmse = sum.position.root().value_or(std::numeric_limits<double>::infinity());
    return std::isfinite(rmse) ? rmse : std::numeric_limits<double>::infinity();
  }

  const Trial& trial_;
  const LabelledRuns& runs_;
  double unit_;  // process noise of tracking index 1
};

/// The objects of one regime in all runs.
LabelledRuns runs_of(const LabelledRuns& all, const Subject& regime) {
  LabelledRuns chosen;
  for (const std::vector<LabelledObject>& run : all) {
    std::copy_if(run.begin(), run.end(), std::back_inserter(chosen.emplace_back()),
                 [&](const LabelledObject& object) {
                   return std::binary_search(regime.objects.begin(), regime.objects.end(),
                                             object.id);
                 });
  }
  return chosen;
}

LabelledRuns labelled_runs(const Trial& trial, int first, const TuningOptions& options) {
  LabelledRuns runs(static_cast<std::size_t>(options.runs));
  const std::vector<ObjectId> objects = some_objects(trial, kMostScans / runs.size());
  in_parallel(runs.size(), options.jobs, [&](std::size_t i) {
    const int run = first + static_cast<int>(i);
    runs[i] = labelled_objects(trial, run, trial.truth_of(run), objects);
  });
  return runs;
}

}  // namespace

std::map<std::string, FilterConfig> tuned_filters(const Trial& trial, const LabelledRuns& runs,
                                                  std::span<const TunedKind> kinds) {
  const AllTuner tuner(trial, runs);
  const bool needs_kalman = std::any_of(kinds.begin(), kinds.end(), [](TunedKind kind) {
    return kind == TunedKind::kKalman || kind == TunedKind::kImm;
  });
  const AllTuner::Kalman kalman = needs_kalman ? tuner.kalman() : AllTuner::Kalman{};
  std::map<std::string, FilterConfig> filters;
  for (const TunedKind kind : kinds) {
    switch (kind) {
      case TunedKind::kGh:
        filters["tuned g-h"] = tuner.gains(1);
        break;
      case TunedKind::kGhk:
        filters["tuned g-h-k"] = tuner.gains(2);
        break;
      case TunedKind::kKalman:
        filters["tuned Kalman"] = kalman.config;
        break;
      case TunedKind::kImm:
        filters["tuned IMM"] = tuner.interacting(kalman);
        break;
    }
  }
  return filters;
}

Tuning tune(const WorldScene& scene, const TuningOptions& options,
            const std::function<void()>& on_step) {
  for (const int order : options.orders) {
    if (options.rule && !gains_of_rule(*options.rule, order)) {
      throw std::invalid_argument("there is no family of gains called '" + *options.rule + "'");
    }
  }
  const Trial trial(scene, on_step);
  const LabelledRuns training = labelled_runs(trial, kFirstTuningRun, options);
  const LabelledRuns judging = labelled_runs(trial, kFirstJudgingRun, options);
  const std::vector<SubjectTheory> theory =
      theory_of(trial, trial.truth(), kFirstJudgingRun, options.runs, options.jobs);

  std::vector<std::size_t> regimes;  // among the subjects
  for (std::size_t i = 0; i < trial.subjects().size(); ++i) {
    const Subject& subject = trial.subjects()[i];
    if (!subject.regime.empty() && subject.object.empty()) regimes.push_back(i);
  }
  Tuning tuning;
  tuning.scene = scene.name;
  tuning.runs = options.runs;
  tuning.sigma = trial.scoring().sigma;
  tuning.period = trial.scoring().period;
  tuning.regimes.resize(regimes.size());
  in_parallel(regimes.size(), options.jobs, [&](std::size_t i) {
    const Subject& subject = trial.subjects()[regimes[i]];
    tuning.regimes[i] = RegimeTuner(trial, subject.regime, runs_of(training, subject),
                                    runs_of(judging, subject), options)
                            .result(theory[regimes[i]]);
  });
  tuning.surfaces = gain_surfaces(trial, trial.truth_of(kFirstTuningRun), options.jobs);
  return tuning;
}

}  // namespace ghtrack
