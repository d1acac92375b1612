#include "tracker/association/belief_propagation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/portable_math.hpp"

namespace ghtrack {
namespace {

// In crowds that no sensor could resolve, messages settle slowly and their precision is worth
// little.
constexpr double kMostRounds = 1000.0;
constexpr double kFewestRounds = 10.0;
constexpr double kMostWork = 1e7;    // rounds times pairs
constexpr double kConverged = 1e-6;  // greatest relative change of a message in a round

/// The messages along every pair, in the order of the table.
class Messages {
 public:
  Messages(const CandidateTable& table, const std::vector<double>& weights, int detections)
      : table_(table),
        weights_(weights),
        to_detection_(weights.size(), 0.0),
        to_track_(weights.size(), 1.0),
        heard_(static_cast<std::size_t>(detections), 0.0) {}

  void converge() {
    const double affordable = kMostWork / (1.0 + static_cast<double>(weights_.size()));
    const int rounds = static_cast<int>(std::clamp(affordable, kFewestRounds, kMostRounds));
    for (int round = 0; round < rounds; ++round) {
      if (exchange() < kConverged) break;
    }
  }

  Marginals marginals() const {
    Marginals result;
    result.pair.resize(weights_.size());
    result.missed.reserve(static_cast<std::size_t>(table_.rows()));
    for (int row = 0; row < table_.rows(); ++row) {
      const double total = 1.0 + support(row);
      for (int k = table_.row_start[row]; k < table_.row_start[row + 1]; ++k) {
        result.pair[k] = weights_[k] * to_track_[k] / total;
        result.log_sum -= portable::log1p(to_detection_[k] * to_track_[k]);
      }
      result.missed.push_back(1.0 / total);
      result.log_sum += portable::log(total);
    }
    result.unused.reserve(heard_.size());
    for (const double heard : heard_) {
      result.unused.push_back(1.0 / (1.0 + heard));
      result.log_sum += portable::log1p(heard);
    }
    return result;
  }

 private:
  /// Σ wᵢⱼ νⱼᵢ of a track.
  double support(int row) const {
    double sum = 0.0;
    for (int k = table_.row_start[row]; k < table_.row_start[row + 1]; ++k) {
      sum += weights_[k] * to_track_[k];
    }
    return sum;
  }

  /// All tracks speak, then all detections. @returns how much the latter changed
  double exchange() {
    std::fill(heard_.begin(), heard_.end(), 0.0);
    for (int row = 0; row < table_.rows(); ++row) {
      const double total = 1.0 + support(row);
      for (int k = table_.row_start[row]; k < table_.row_start[row + 1]; ++k) {
        to_detection_[k] = weights_[k] / (total - weights_[k] * to_track_[k]);
        heard_[table_.candidates[k].detection] += to_detection_[k];
      }
    }
    double change = 0.0;
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      const double others = heard_[table_.candidates[k].detection] - to_detection_[k];
      const double next = 1.0 / (1.0 + std::max(0.0, others));
      change = std::max(change, std::abs(next - to_track_[k]));
      to_track_[k] = next;
    }
    return change;
  }

  const CandidateTable& table_;
  const std::vector<double>& weights_;
  std::vector<double> to_detection_, to_track_;  // μ and ν of each pair
  std::vector<double> heard_;                    // Σ μᵢⱼ of each detection
};

/// Adds up the weights of all joint assignments, track by track.
class Enumeration {
 public:
  Enumeration(const CandidateTable& table, const std::vector<double>& weights, int detections)
      : table_(table), weights_(weights), is_taken_(static_cast<std::size_t>(detections)) {
    result_.pair.resize(weights.size());
    result_.missed.resize(static_cast<std::size_t>(table.rows()));
    result_.unused.resize(static_cast<std::size_t>(detections));
  }

  Marginals marginals() {
    const double total = sum_from(0, 1.0);
    for (auto* values : {&result_.pair, &result_.missed, &result_.unused}) {
      for (double& value : *values) value /= total;
    }
    result_.log_sum = portable::log(total);
    return result_;
  }

 private:
  /// The weight of all ways for the tracks from `row` on, when what was chosen before weighs that.
  double sum_from(int row, double weight) {
    if (row == table_.rows()) {
      for (std::size_t j = 0; j < is_taken_.size(); ++j) {
        if (!is_taken_[j]) result_.unused[j] += weight;
      }
      return weight;
    }
    double sum = sum_from(row + 1, weight);
    result_.missed[row] += sum;
    for (int k = table_.row_start[row]; k < table_.row_start[row + 1]; ++k) {
      const auto detection = static_cast<std::size_t>(table_.candidates[k].detection);
      if (is_taken_[detection]) continue;
      is_taken_[detection] = true;
      const double with = sum_from(row + 1, weight * weights_[k]);
      is_taken_[detection] = false;
      result_.pair[k] += with;
      sum += with;
    }
    return sum;
  }

  const CandidateTable& table_;
  const std::vector<double>& weights_;
  std::vector<bool> is_taken_;
  Marginals result_;
};

}  // namespace

Marginals marginals_by_belief_propagation(const CandidateTable& table,
                                          const std::vector<double>& weights, int detections) {
  Messages messages(table, weights, detections);
  messages.converge();
  return messages.marginals();
}

Marginals marginals_by_enumeration(const CandidateTable& table, const std::vector<double>& weights,
                                   int detections) {
  return Enumeration(table, weights, detections).marginals();
}

}  // namespace ghtrack
