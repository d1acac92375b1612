#include "tracker/association/k_best.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace ghtrack {
namespace {

/// A part of a problem's solutions, and the best one in it: the tracks before `fixed` have the
/// detections of that solution, and the track `fixed` has none of the forbidden ones.
struct Part {
  RankedAssignment best;
  int fixed = 0;
  std::vector<int> forbidden;

  bool operator>(const Part& other) const { return best.cost > other.best.cost; }
};

class Ranking {
 public:
  Ranking(std::span<const AssignmentProblem> problems, int detections, std::size_t most,
          double within)
      : problems_(problems), detections_(detections), most_(most), within_(within) {}

  std::vector<RankedAssignment> run() {
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      Part whole;
      whole.best.problem = static_cast<int>(i);
      add(std::move(whole), {});
    }
    std::vector<RankedAssignment> ranked;
    while (!parts_.empty() && ranked.size() < most_) {
      std::pop_heap(parts_.begin(), parts_.end(), std::greater<>{});
      const Part part = std::move(parts_.back());
      parts_.pop_back();
      if (part.best.cost > limit_) break;
      ranked.push_back(part.best);
      if (ranked.size() < most_) divide(part);
    }
    return ranked;
  }

 private:
  /// All solutions of a part but its best: they have the same detections up to some track, and
  /// another one there.
  void divide(const Part& part) {
    const int rows = problems_[part.best.problem].table.rows();
    for (int row = part.fixed; row < rows; ++row) {
      Part rest;
      rest.best.problem = part.best.problem;
      rest.fixed = row;
      if (row == part.fixed) rest.forbidden = part.forbidden;
      rest.forbidden.push_back(part.best.detection_of[row]);
      add(std::move(rest), part.best.detection_of);
    }
  }

  /// Solves a part and puts it in the queue, if what is in it is good enough.
  /// @param start  detections of the fixed tracks
  void add(Part part, const std::vector<int>& start) {
    const auto& [base, table] = problems_[part.best.problem];
    const auto is_fixed = [&](int detection) {
      const auto end = start.begin() + part.fixed;
      return std::find(start.begin(), end, detection) != end;
    };
    const auto is_forbidden = [&](int detection) {
      return std::find(part.forbidden.begin(), part.forbidden.end(), detection) !=
             part.forbidden.end();
    };
    double cost = base;
    for (int row = 0; row < part.fixed; ++row) cost += cost_of(table, row, start[row]);
    rest_.row_start.assign(1, 0);
    rest_.candidates.clear();
    double bound = cost;  // no solution of the part can cost less
    const bool must_have = is_forbidden(kMissed);
    for (int row = part.fixed; row < table.rows(); ++row) {
      const bool is_choosy = row == part.fixed;
      double least = is_choosy && must_have ? kHuge : 0.0;
      for (const Candidate& candidate : table.row(row)) {
        if (is_fixed(candidate.detection)) continue;
        if (is_choosy && is_forbidden(candidate.detection)) continue;
        least = std::min(least, candidate.cost);
        const double bonus = is_choosy && must_have ? kHuge : 0.0;
        rest_.candidates.push_back({candidate.detection, candidate.cost - bonus});
      }
      bound += least;
      rest_.close_row();
    }
    if (bound > limit_) return;
    part.best.detection_of.assign(start.begin(), start.begin() + part.fixed);
    for (const int detection : assign_globally(rest_, detections_, 0.0)) {
      cost += cost_of(table, static_cast<int>(part.best.detection_of.size()), detection);
      part.best.detection_of.push_back(detection);
    }
    if (must_have && part.best.detection_of[part.fixed] == kMissed) return;
    if (cost > limit_) return;
    part.best.cost = cost;
    limit_ = std::min(limit_, cost + within_);
    parts_.push_back(std::move(part));
    std::push_heap(parts_.begin(), parts_.end(), std::greater<>{});
  }

  static double cost_of(const CandidateTable& table, int row, int detection) {
    if (detection == kMissed) return 0.0;
    for (const Candidate& candidate : table.row(row)) {
      if (candidate.detection == detection) return candidate.cost;
    }
    return kHuge;
  }

  static constexpr double kHuge = 1e9;

  std::span<const AssignmentProblem> problems_;
  int detections_;
  std::size_t most_;
  double within_;
  double limit_ = std::numeric_limits<double>::infinity();  // what costs more is not wanted
  std::vector<Part> parts_;                                 // a heap, the best one on top
  CandidateTable rest_;
};

}  // namespace

std::vector<RankedAssignment> best_assignments(std::span<const AssignmentProblem> problems,
                                               int detections, std::size_t most, double within) {
  return Ranking(problems, detections, most, within).run();
}

}  // namespace ghtrack
