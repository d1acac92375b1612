#include "tools/metrics/trajectory_gospa.hpp"

#include <coin/Clp_C_Interface.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <unordered_map>

#include "tools/metrics/close_pairs.hpp"
#include "tools/metrics/power.hpp"

namespace ghtrack {
namespace {

constexpr std::int64_t kMostMeetings = 5'000'000;  // that are kept
constexpr std::size_t kLargestInPassing = 10'000;  // shares W of a group

/// Sets with the operations of union-find.
class Partition {
 public:
  int find(int member) {
    while (parent_[static_cast<std::size_t>(member)] != member) {
      auto& parent = parent_[static_cast<std::size_t>(member)];
      parent = parent_[static_cast<std::size_t>(parent)];
      member = parent;
    }
    return member;
  }
  void join(int a, int b) { parent_[static_cast<std::size_t>(find(a))] = find(b); }
  int add() {
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }

 private:
  std::vector<int> parent_;
};

/// A linear programme in columns: minimise cost · x under row bounds, for CLP (Forrest et al.).
class Programme {
 public:
  int add_row(double low, double high) {
    row_low_.push_back(low);
    row_high_.push_back(high);
    return static_cast<int>(row_low_.size()) - 1;
  }

  /// A variable in [0, high] with its cost and its entries by row.
  void add_column(double cost, double high, std::initializer_list<std::pair<int, double>> entries) {
    cost_.push_back(cost);
    high_.push_back(high);
    for (const auto& [row, value] : entries) {
      if (row < 0) continue;
      rows_.push_back(row);
      values_.push_back(value);
    }
    starts_.push_back(static_cast<CoinBigIndex>(rows_.size()));
  }

  std::vector<double> solve() const {
    const std::unique_ptr<Clp_Simplex, decltype(&Clp_deleteModel)> model(Clp_newModel(),
                                                                         &Clp_deleteModel);
    Clp_setLogLevel(model.get(), 0);
    const std::vector<double> low(cost_.size(), 0.0);
    Clp_loadProblem(model.get(), static_cast<int>(cost_.size()), static_cast<int>(row_low_.size()),
                    starts_.data(), rows_.data(), values_.data(), low.data(), high_.data(),
                    cost_.data(), row_low_.data(), row_high_.data());
    Clp_setPrimalTolerance(model.get(), 1e-9);
    Clp_setDualTolerance(model.get(), 1e-9);
    Clp_initialDualSolve(model.get());
    if (Clp_status(model.get()) != 0) throw std::runtime_error("T-GOSPA: CLP found no optimum");
    const double* const solution = Clp_primalColumnSolution(model.get());
    return {solution, solution + cost_.size()};
  }

 private:
  std::vector<double> row_low_, row_high_, cost_, high_, values_;
  std::vector<int> rows_;
  std::vector<CoinBigIndex> starts_ = {0};
};

}  // namespace

TrajectoryGospa::TrajectoryGospa(const TrajectoryGospaOptions& options) : options_(options) {
  if (!(options.switching_penalty > 0.0)) {
    throw std::invalid_argument("T-GOSPA's penalty of a switch must be above 0");
  }
}

void TrajectoryGospa::add(std::span<const std::int64_t> truth_ids,
                          std::span<const Eigen::Vector2d> truth,
                          std::span<const std::int64_t> track_ids,
                          std::span<const Eigen::Vector2d> tracks) {
  truths_ += std::ssize(truth);
  tracks_ += std::ssize(tracks);
  if (!is_full_) {
    // A norm of higher order than 2 is up to √2 times shorter.
    for (const Pair& pair : close_pairs(truth, tracks, std::sqrt(2.0) * options_.cutoff)) {
      const Eigen::Array2d apart =
          (truth[pair.truth] - tracks[pair.track]).array().abs() / options_.cutoff;
      const double cost = apart.pow(options_.order).sum();
      if (!(cost < 1.0)) continue;
      meetings_[{truth_ids[pair.truth], track_ids[pair.track]}].push_back({instant_, cost});
      ++meeting_count_;
    }
    if (meeting_count_ > kMostMeetings) {
      is_full_ = true;
      meetings_.clear();
    }
  }
  ++instant_;
}

/// The pairs in groups that share no object and no track.
std::vector<TrajectoryGospa::Group> TrajectoryGospa::groups() const {
  Partition partition;
  std::unordered_map<std::int64_t, int> truths, tracks;
  const auto member = [&](auto& members, std::int64_t id) {
    const auto [at, is_new] = members.try_emplace(id, 0);
    if (is_new) at->second = partition.add();
    return at->second;
  };
  for (const auto& [pair, meetings] : meetings_) {
    partition.join(member(truths, pair.first), member(tracks, pair.second));
  }
  std::map<int, Group> by_root;
  for (auto at = meetings_.begin(); at != meetings_.end(); ++at) {
    by_root[partition.find(truths.at(at->first.first))].push_back(at);
  }
  std::vector<Group> result;
  for (auto& [root, group] : by_root) result.push_back(std::move(group));
  return result;
}

/// The instants at which a pair of the group is close.
std::vector<std::int64_t> TrajectoryGospa::instants_of(const Group& group) {
  std::vector<std::int64_t> instants;
  for (const auto& pair : group) {
    for (const Meeting& meeting : pair->second) instants.push_back(meeting.instant);
  }
  std::sort(instants.begin(), instants.end());
  instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
  return instants;
}

/// Minimises Σ (cost − 1) W + (γ/c)^p / 2 Σ |ΔW|, in units of c^p: a pair that is given costs
/// `cost` and saves one missed and one false of 1/2 each. With u ≥ ΔW, u ≥ 0, Σ |ΔW| / 2 = Σ u −
/// (W(end) − W(start)) / 2.
TrajectoryGospa::Solution TrajectoryGospa::solve(const Group& group) const {
  Solution solution;
  if (group.size() == 1) {  // no rivals, so that they are always together
    for (const Meeting& meeting : group.front()->second) solution.localisation += meeting.cost;
    solution.matched = static_cast<double>(group.front()->second.size());
    return solution;
  }
  const std::vector<std::int64_t> instants = instants_of(group);
  constexpr double kFree = 1e30;
  const double penalty = power(options_.switching_penalty / options_.cutoff, options_.order);
  const std::size_t count = instants.size();
  Programme programme;
  std::map<std::int64_t, std::vector<int>> truth_rows, track_rows;
  const auto rows_of = [&](auto& rows, std::int64_t id) -> const std::vector<int>& {
    std::vector<int>& own = rows[id];
    for (std::size_t k = own.size(); k < count; ++k) own.push_back(programme.add_row(-kFree, 1.0));
    return own;
  };
  std::vector<std::vector<double>> costs;  // of each pair at each instant; 1: not close
  for (const auto& pair : group) {
    std::vector<double>& cost = costs.emplace_back(count, 1.0);
    for (const Meeting& meeting : pair->second) {
      const auto at = std::lower_bound(instants.begin(), instants.end(), meeting.instant);
      cost[static_cast<std::size_t>(at - instants.begin())] = meeting.cost;
    }
    const std::vector<int>& by_truth = rows_of(truth_rows, pair->first.first);
    const std::vector<int>& by_track = rows_of(track_rows, pair->first.second);
    int change = -1;  // the row W(k) − W(k−1) − u ≤ 0
    for (std::size_t k = 0; k < count; ++k) {
      const bool is_last = k + 1 == count;
      const int next = is_last ? -1 : programme.add_row(-kFree, 0.0);
      const double ends = (k == 0 ? 0.5 : 0.0) - (is_last ? 0.5 : 0.0);
      programme.add_column(cost[k] - 1.0 + penalty * ends, 1.0,
                           {{by_truth[k], 1.0}, {by_track[k], 1.0}, {change, 1.0}, {next, -1.0}});
      if (!is_last) programme.add_column(penalty, kFree, {{next, -1.0}});
      change = next;
    }
  }
  const std::vector<double> x = programme.solve();
  std::size_t column = 0;
  for (const std::vector<double>& cost : costs) {
    double before = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const double share = x[column];
      if (cost[k] < 1.0) {
        solution.localisation += share * cost[k];
        solution.matched += share;
      }
      if (k > 0) solution.changes += std::abs(share - before) / 2.0;
      before = share;
      column += k + 1 == count ? 1 : 2;
    }
  }
  return solution;
}

std::optional<TrajectoryGospaResult> TrajectoryGospa::result(bool whatever_it_takes) const {
  if (is_full_) return std::nullopt;
  const std::vector<Group> all = groups();
  Solution sum;
  for (const Group& group : all) {
    if (!whatever_it_takes && group.size() > 1 &&
        group.size() * instants_of(group).size() > kLargestInPassing) {
      return std::nullopt;
    }
    const Solution solution = solve(group);
    sum.localisation += solution.localisation;
    sum.matched += solution.matched;
    sum.changes += solution.changes;
  }
  const double unit = power(options_.cutoff, options_.order);
  TrajectoryGospaResult result;
  result.localisation = unit * sum.localisation;
  result.missed = unit / 2.0 * (static_cast<double>(truths_) - sum.matched);
  result.false_tracks = unit / 2.0 * (static_cast<double>(tracks_) - sum.matched);
  result.switches = power(options_.switching_penalty, options_.order) * sum.changes;
  const double total = result.localisation + result.missed + result.false_tracks + result.switches;
  result.tgospa = power(total, 1.0 / options_.order);
  return result;
}

TrajectoryGospaResult combine(std::span<const TrajectoryGospaResult> results, double order) {
  TrajectoryGospaResult sum;
  for (const TrajectoryGospaResult& result : results) {
    sum.localisation += result.localisation;
    sum.missed += result.missed;
    sum.false_tracks += result.false_tracks;
    sum.switches += result.switches;
  }
  sum.tgospa = power(sum.localisation + sum.missed + sum.false_tracks + sum.switches, 1.0 / order);
  return sum;
}

}  // namespace ghtrack
