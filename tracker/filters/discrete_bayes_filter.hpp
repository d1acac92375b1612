#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tracker/filters/discrete_bayes.hpp"
#include "tracker/filters/kinematics.hpp"

namespace ghtrack {

/// A histogram filter as a scene says it: the places 0, 1, … of a row, and what a sensor reads
/// there.
struct DiscreteBayesConfig {
  static constexpr std::string_view kind = "discrete-bayes";
  static constexpr std::string_view about =
      "Histogram filter: a probability for each place of a row; may believe in several at once.";

  int cells = 10;
  std::vector<double> map;  // what is read in each place; empty: the place itself
  double accuracy = 0.75;   // probability that a reading of the map is right
  double noise = 1.0;       // 1-sigma error of a measured place
  int movement = 0;         // places per step
  std::vector<double> kernel = {1.0};
  bool ring = true;

  template <class Visitor>
  static void describe(Visitor& v) {
    v.field("cells", &DiscreteBayesConfig::cells,
            {.unit = "1",
             .meaning = "number of places, without a map",
             .minimum = 2,
             .maximum = 10'000});
    v.field("map", &DiscreteBayesConfig::map,
            {.meaning = "what the sensor reads in each place, such as 1 at a door and 0 at a wall; "
                        "without a map it measures the number of the place",
             .max_items = 10'000});
    v.field("accuracy", &DiscreteBayesConfig::accuracy,
            {.unit = "1",
             .meaning = "probability that a reading of the map is right",
             .above = 0.0,
             .below = 1.0});
    v.field("noise", &DiscreteBayesConfig::noise,
            {.meaning = "1-sigma error of a measured place, without a map", .above = 0.0});
    v.field("movement", &DiscreteBayesConfig::movement,
            {.unit = "1", .meaning = "places moved in a step", .minimum = -1000, .maximum = 1000});
    v.field("kernel", &DiscreteBayesConfig::kernel,
            {.unit = "1",
             .meaning = "probabilities of moving less, as meant and more, such as [0.1, 0.8, 0.1]; "
                        "the middle one is that of the movement itself",
             .minimum = 0.0,
             .min_items = 1,
             .max_items = 1001});
    v.field(
        "ring", &DiscreteBayesConfig::ring,
        {.meaning = "the last place is beside the first; otherwise what leaves the row is lost"});
  }

  template <class Report>
  void check(Report&& report) const {
    double sum = 0.0;
    for (const double weight : kernel) sum += weight;
    if (!(sum > 0.0)) report("kernel", "one of the probabilities must be positive");
    if (kernel.size() % 2 == 0) report("kernel", "an odd number of probabilities has a middle one");
    if (map.size() == 1) report("map", "at least two places are needed");
  }
};

/// The histogram filter of one variable. It starts with every place equally likely.
class DiscreteBayesFilter {
 public:
  using Vector = Kinematics<1>::Vector;

  explicit DiscreteBayesFilter(const DiscreteBayesConfig& config);

  /// Forgets all, then believes the first measurement.
  bool start(const Vector& z);
  /// One step, whatever its length: the belief moves and spreads. @returns false if refused
  bool predict(double dt);
  /// Likelihood times prior. A measurement that no place explains is refused.
  bool update(const Vector& z);
  /// Says that there is no measurement for this prediction.
  void coast() { residual_.reset(); }

  const discrete_bayes::Belief& belief() const { return belief_; }
  /// The likeliest place, the first of equals.
  const Kinematics<1>& prior() const { return prior_; }
  const Kinematics<1>& estimate() const { return estimate_; }
  /// Measured minus expected: with a map what was read minus what the likeliest place shows; on a
  /// ring the short way round.
  const std::optional<Vector>& residual() const { return residual_; }
  const Refusals& refusals() const { return refusals_; }

 private:
  double likelihood(std::size_t cell, double z) const;
  double expected_at(std::size_t cell) const;
  void choose();

  DiscreteBayesConfig config_;
  discrete_bayes::Belief kernel_;
  discrete_bayes::Belief belief_;
  std::size_t likeliest_ = 0;
  Kinematics<1> prior_;
  Kinematics<1> estimate_;
  std::optional<Vector> residual_;
  Refusals refusals_;
};

}  // namespace ghtrack
