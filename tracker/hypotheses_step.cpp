#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/portable_math.hpp"
#include "tracker/association/k_best.hpp"
#include "tracker/life_cycle.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostHypotheses = 100;   // in a cluster
constexpr double kWithin = 11.5;               // ln of how much likelier the likeliest one may be
constexpr double kLeastOddsConsidered = 1e-4;  // of a pair that is considered
constexpr double kMostWork = 4000.0;           // hypotheses times targets
constexpr std::size_t kMostJoint = 24;         // targets that are explained together

/// A branch in a scan: its detections, and what it costs to have none.
struct Prospect {
  std::vector<Candidate> candidates;  // cost: −ln of the odds of this pair to none
  double detection = 0.0;             // probability that it had to be detected
  double log_missed = 0.0;
};

/// A cluster in a scan.
struct Scene {
  TrackCluster cluster;
  std::vector<std::vector<Prospect>> prospects;  // of each target's branches
};

double log_sum(const std::vector<Hypothesis>& hypotheses) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Hypothesis& h : hypotheses) most = std::max(most, h.log_weight);
  double sum = 0.0;
  for (const Hypothesis& h : hypotheses) sum += portable::exp(h.log_weight - most);
  return most + portable::log(sum);
}

/// Makes the weights sum up to 1. @returns the ln of what they did before
double normalise(std::vector<Hypothesis>& hypotheses) {
  const double sum = log_sum(hypotheses);
  for (Hypothesis& h : hypotheses) h.log_weight -= sum;
  return sum;
}

/// Likeliest first; leaves out what is too unlikely or too much.
void cut(std::vector<Hypothesis>& hypotheses, std::size_t most) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const auto& a, const auto& b) { return a.log_weight > b.log_weight; });
  const double least = hypotheses.front().log_weight - kWithin;
  while (hypotheses.size() > most || hypotheses.back().log_weight < least) hypotheses.pop_back();
}

std::size_t most_hypotheses(std::size_t targets) {
  const double affordable = kMostWork / static_cast<double>(std::max<std::size_t>(1, targets));
  return std::clamp<std::size_t>(static_cast<std::size_t>(affordable), 1, kMostHypotheses);
}

/// Every explanation of one together with every one of the other.
void join(Scene& scene, Scene&& other) {
  const std::size_t targets = scene.cluster.targets.size() + other.cluster.targets.size();
  std::vector<Hypothesis> joint;
  for (const Hypothesis& a : scene.cluster.hypotheses) {
    for (const Hypothesis& b : other.cluster.hypotheses) {
      Hypothesis& both = joint.emplace_back(a);
      both.log_weight += b.log_weight;
      both.branch_of.insert(both.branch_of.end(), b.branch_of.begin(), b.branch_of.end());
    }
  }
  cut(joint, most_hypotheses(targets));
  normalise(joint);
  scene.cluster.hypotheses = std::move(joint);
  std::move(other.cluster.targets.begin(), other.cluster.targets.end(),
            std::back_inserter(scene.cluster.targets));
  std::move(other.prospects.begin(), other.prospects.end(), std::back_inserter(scene.prospects));
}

/// One scan under all hypotheses.
class MultiScan {
 public:
  MultiScan(Look& look, TrackerState& state)
      : look_(look),
        state_(state),
        evidence_(look.design.evidence(look.scan.sensor)),
        members_(look.grid.members()),
        scene_of_(members_.size(), kNobody) {
    const double undetected = state.undetected.before_look(evidence_, look.scan.sensor, state.time);
    nobodys_ = evidence_.nobodys(undetected);
    real_ = evidence_.detection_probability * undetected / nobodys_;
  }

  void run() {
    predict_all();
    look_.clock.finished(&StepTimes::predict);
    const std::vector<std::vector<std::size_t>> groups = competitors();
    look_.clock.finished(&StepTimes::associate);
    state_.log_likelihood = evidence_.log_nobodys(nobodys_, members_.size());
    state_.clusters.clear();
    for (const std::vector<std::size_t>& group : groups) update(group);
    look_.clock.finished(&StepTimes::update);
    begin_alone();
    state_.undetected.after_look(evidence_, look_.scan.sensor);
    report();
    look_.clock.finished(&StepTimes::begin);
  }

 private:
  static constexpr int kNobody = -1;

  void predict_all() {
    const double stay = survival(look_.elapsed, evidence_.lifetime);
    for (TrackCluster& cluster : state_.clusters) {
      Scene& scene = scenes_.emplace_back();
      scene.cluster = std::move(cluster);
      for (TrackTree& target : scene.cluster.targets) {
        auto& prospects = scene.prospects.emplace_back();
        for (Branch& branch : target.branches) {
          predict(branch.track, look_.elapsed);
          *branch.track.existence *= stay;
          prospects.push_back(prospect_of(branch.track));
        }
      }
    }
  }

  Prospect prospect_of(const Track& track) const {
    const double r = *track.existence;
    const double p = evidence_.detection_probability;
    Prospect result;
    result.detection = is_due(track, look_.config(), look_.sensor, look_.scan.time) ? p : 0.0;
    const double missed = 1.0 - r * result.detection;
    result.log_missed = portable::log(missed);
    const double base = portable::log(2.0 * std::numbers::pi * nobodys_ * missed / (r * p));
    std::vector<Gated> gated;
    look_.grid.find_in_gate(reach(track), look_.config().gate, gated);
    for (const Gated& near : gated) {
      const double cost = base + surprise(track, near, members_[near.member]);
      if (cost < -portable::log(kLeastOddsConsidered))
        result.candidates.push_back({near.member, cost});
    }
    return result;
  }

  /// The scenes in groups that compete for a detection now, in their order; notes whose each
  /// detection may be.
  std::vector<std::vector<std::size_t>> competitors() {
    std::vector<int> parent(scenes_.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      for (const auto& prospects : scenes_[i].prospects) {
        for (const Prospect& prospect : prospects) {
          for (const Candidate& candidate : prospect.candidates) {
            int& owner = scene_of_[candidate.detection];
            if (owner == kNobody) owner = static_cast<int>(i);
            const int a = root(owner);
            const int b = root(static_cast<int>(i));
            parent[std::max(a, b)] = std::min(a, b);
          }
        }
      }
    }
    std::vector<std::vector<std::size_t>> by_root(scenes_.size());
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      by_root[static_cast<std::size_t>(root(static_cast<int>(i)))].push_back(i);
    }
    std::erase_if(by_root, [](const auto& group) { return group.empty(); });
    return by_root;
  }

  /// Few targets are explained together. Of many no list of joint explanations could be long
  /// enough: each then is one track, and shares detections by their marginal probabilities.
  void update(const std::vector<std::size_t>& group) {
    std::size_t targets = 0;
    for (const std::size_t i : group) targets += scenes_[i].cluster.targets.size();
    if (targets > kMostJoint) {
      update_marginally(group);
      return;
    }
    Scene joint = std::move(scenes_[group.front()]);
    for (std::size_t i = 1; i < group.size(); ++i) join(joint, std::move(scenes_[group[i]]));
    update(std::move(joint));
  }

  /// The likeliest track of a target, with its existence under all hypotheses; nothing for one that
  /// hardly exists.
  std::optional<Track> marginal(const TrackCluster& cluster, std::size_t target) const {
    double exists = 0.0;
    std::vector<double> weights(cluster.targets[target].branches.size(), 0.0);
    for (const Hypothesis& h : cluster.hypotheses) {
      const int branch = h.branch_of[target];
      if (branch != Hypothesis::kAbsent) weights[branch] += portable::exp(h.log_weight);
    }
    for (std::size_t b = 0; b < weights.size(); ++b) {
      weights[b] *= *cluster.targets[target].branches[b].track.existence;
      exists += weights[b];
    }
    if (exists < look_.config().existence.drop) return std::nullopt;
    const auto likeliest = std::max_element(weights.begin(), weights.end()) - weights.begin();
    Track track = cluster.targets[target].branches[likeliest].track;
    track.existence = std::min(exists, 1.0);
    return track;
  }

  void update_marginally(const std::vector<std::size_t>& group) {
    std::vector<Track> tracks;
    std::vector<TrackTree> trees;  // of each track, without branches
    std::vector<bool> is_claimed(members_.size(), false);
    for (const std::size_t i : group) {
      const TrackCluster& cluster = scenes_[i].cluster;
      for (std::size_t t = 0; t < cluster.targets.size(); ++t) {
        std::optional<Track> track = marginal(cluster, t);
        if (!track) continue;
        tracks.push_back(std::move(*track));
        trees.push_back(
            {.birth = cluster.targets[t].birth, .id = cluster.targets[t].id, .branches = {}});
      }
      for (const int detection : detections_of(scenes_[i])) is_claimed[detection] = true;
    }
    const std::vector<double> unused =
        weigh_detections(look_, nobodys_, tracks, state_.log_likelihood);
    const auto keep = [&](TrackTree&& target, Track&& track, int recent) {
      TrackCluster& cluster = state_.clusters.emplace_back();
      target.branches.push_back({.track = std::move(track), .recent = {recent}});
      cluster.targets.push_back(std::move(target));
      cluster.hypotheses.push_back({.log_weight = 0.0, .branch_of = {0}});
    };
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (is_worth_keeping(tracks[i])) keep(std::move(trees[i]), std::move(tracks[i]), 0);
    }
    for (std::size_t j = 0; j < members_.size(); ++j) {
      const double existence = unused[j] * real_;
      if (!is_claimed[j] || existence < look_.config().existence.drop) continue;
      TrackTree target = begin(static_cast<int>(j), existence);
      Track track = std::move(target.branches.front().track);
      target.branches.clear();
      keep(std::move(target), std::move(track), static_cast<int>(j) + 1);
    }
  }

  /// The detections that anybody in the scene may take, in their order.
  std::vector<int> detections_of(const Scene& scene) const {
    std::vector<int> detections;
    for (const auto& prospects : scene.prospects) {
      for (const Prospect& prospect : prospects) {
        for (const Candidate& c : prospect.candidates) detections.push_back(c.detection);
      }
    }
    std::sort(detections.begin(), detections.end());
    detections.erase(std::unique(detections.begin(), detections.end()), detections.end());
    return detections;
  }

  AssignmentProblem problem_of(const Scene& scene, const Hypothesis& hypothesis,
                               const std::vector<int>& detections) const {
    AssignmentProblem problem{.base = -hypothesis.log_weight, .table = {}};
    for (std::size_t t = 0; t < hypothesis.branch_of.size(); ++t) {
      if (hypothesis.branch_of[t] == Hypothesis::kAbsent) continue;
      const Prospect& prospect = scene.prospects[t][hypothesis.branch_of[t]];
      problem.base -= prospect.log_missed;
      for (const Candidate& c : prospect.candidates) {
        problem.table.candidates.push_back(
            {static_cast<int>(index_in(detections, c.detection)), c.cost});
      }
      problem.table.close_row();
    }
    return problem;
  }

  /// The track of a branch after it had this detection, or none.
  Branch follow(const Branch& branch, const Prospect& prospect, int member) const {
    Branch next = branch;
    std::shift_right(next.recent.begin(), next.recent.end(), 1);
    if (member == kMissed) {
      next.recent.front() = 0;
      next.track.existence = after_miss(*branch.track.existence, prospect.detection);
      miss(next.track, look_.config(), look_.sensor, look_.scan.time);
    } else {
      next.recent.front() = member + 1;
      next.track.existence = 1.0;
      hit(next.track, members_[member], look_.scan);
    }
    return next;
  }

  bool is_worth_keeping(const Track& track) const {
    return *track.existence >= look_.config().existence.drop &&
           track.unseen < look_.config().drop_unseen;
  }

  TrackTree begin(int member, double existence) {
    TrackTree target{.birth = state_.next_birth++, .id = 0, .branches = {}};
    target.branches.push_back({.track = look_.begin(members_[member])});
    Branch& branch = target.branches.back();
    branch.track.existence = existence;
    branch.recent.front() = member + 1;
    return target;
  }

  /// Replaces the hypotheses of a scene by the likeliest of their continuations.
  void update(Scene&& scene) {
    const std::vector<int> detections = detections_of(scene);
    const auto count = static_cast<int>(detections.size());
    std::vector<AssignmentProblem> problems;
    for (const Hypothesis& h : scene.cluster.hypotheses) {
      problems.push_back(problem_of(scene, h, detections));
    }
    const std::vector<RankedAssignment> ranked =
        best_assignments(problems, count, most_hypotheses(scene.cluster.targets.size()), kWithin);

    // The old targets go on; a detection that is left may be a new one.
    const std::size_t old = scene.cluster.targets.size();
    TrackCluster next;
    next.targets.resize(old);
    for (std::size_t t = 0; t < old; ++t) {
      next.targets[t].birth = scene.cluster.targets[t].birth;
      next.targets[t].id = scene.cluster.targets[t].id;
    }
    std::map<std::tuple<std::size_t, int, int>, int> known;  // target, branch, detection
    std::vector<double> unused(detections.size(), 0.0);
    for (const RankedAssignment& assignment : ranked) {
      const Hypothesis& past = scene.cluster.hypotheses[assignment.problem];
      Hypothesis& h = next.hypotheses.emplace_back();
      h.log_weight = -assignment.cost;
      h.branch_of.assign(old + detections.size(), Hypothesis::kAbsent);
      std::fill(h.branch_of.begin() + static_cast<std::ptrdiff_t>(old), h.branch_of.end(), 0);
      std::size_t row = 0;
      for (std::size_t t = 0; t < old; ++t) {
        const int branch = past.branch_of[t];
        if (branch == Hypothesis::kAbsent) continue;
        const int local = assignment.detection_of[row++];
        if (local != kMissed) h.branch_of[old + local] = Hypothesis::kAbsent;
        const auto [place, is_new] = known.try_emplace({t, branch, local}, Hypothesis::kAbsent);
        if (is_new) {
          const int member = local == kMissed ? kMissed : detections[local];
          Branch followed =
              follow(scene.cluster.targets[t].branches[branch], scene.prospects[t][branch], member);
          if (is_worth_keeping(followed.track)) {
            place->second = static_cast<int>(next.targets[t].branches.size());
            next.targets[t].branches.push_back(std::move(followed));
          }
        }
        h.branch_of[t] = place->second;
      }
    }
    state_.log_likelihood += normalise(next.hypotheses);
    for (const Hypothesis& h : next.hypotheses) {
      for (std::size_t j = 0; j < detections.size(); ++j) {
        if (h.branch_of[old + j] != Hypothesis::kAbsent) unused[j] += portable::exp(h.log_weight);
      }
    }
    for (std::size_t j = 0; j < detections.size(); ++j) {
      if (unused[j] * real_ >= look_.config().existence.drop) {
        next.targets.push_back(begin(detections[j], real_));
        continue;
      }
      next.targets.emplace_back();
      for (Hypothesis& h : next.hypotheses) h.branch_of[old + j] = Hypothesis::kAbsent;
    }
    simplify(next);
    split(std::move(next));
  }

  static std::size_t index_in(const std::vector<int>& detections, int detection) {
    return static_cast<std::size_t>(
        std::lower_bound(detections.begin(), detections.end(), detection) - detections.begin());
  }

  /// Hypotheses that agree on the last scans, whichever target they give the detections to, are
  /// one: the likelier one stays, with the weight of both.
  static void simplify(TrackCluster& cluster) {
    std::map<std::uint64_t, std::size_t> known;
    std::vector<Hypothesis> kept;
    for (Hypothesis& h : cluster.hypotheses) {  // likeliest first
      const auto [place, is_new] = known.try_emplace(recent_of(cluster, h), kept.size());
      if (is_new) {
        kept.push_back(std::move(h));
        continue;
      }
      double& weight = kept[place->second].log_weight;
      weight += portable::log1p(portable::exp(h.log_weight - weight));
    }
    cut(kept, kMostHypotheses);
    normalise(kept);
    cluster.hypotheses = std::move(kept);
  }

  static std::uint64_t mixed(std::uint64_t x) {  // SplitMix64
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }

  /// A number for the set of the targets' latest detections.
  static std::uint64_t recent_of(const TrackCluster& cluster, const Hypothesis& h) {
    std::uint64_t sum = 0;
    for (std::size_t t = 0; t < h.branch_of.size(); ++t) {
      if (h.branch_of[t] == Hypothesis::kAbsent) continue;
      const auto& recent = cluster.targets[t].branches[h.branch_of[t]].recent;
      std::uint64_t hash = 0;
      bool is_seen = false;
      for (const int detection : recent) {
        hash = mixed(hash + static_cast<std::uint64_t>(detection));
        is_seen = is_seen || detection != 0;
      }
      if (!is_seen) hash = mixed(hash + static_cast<std::uint64_t>(cluster.targets[t].birth));
      sum += mixed(hash);
    }
    return sum;
  }

  /// Makes clusters of those targets that compete: of what no hypothesis has nothing is left, a
  /// target on which all agree is alone, and so are targets that have shared no detection lately
  /// under any hypotheses. What one group of them has done says nothing of another one.
  void split(TrackCluster&& cluster) {
    const std::vector<int> group = groups_of(cluster);
    for (std::size_t t = 0; t < cluster.targets.size(); ++t) {
      if (group[t] != static_cast<int>(t)) continue;  // its group's first
      std::vector<std::size_t> members;
      for (std::size_t u = t; u < cluster.targets.size(); ++u) {
        if (group[u] == static_cast<int>(t)) members.push_back(u);
      }
      TrackCluster part = part_of(cluster, members);
      cut(part.hypotheses, kMostHypotheses);
      normalise(part.hypotheses);
      state_.clusters.push_back(std::move(part));
    }
  }

  static bool is_agreed(const TrackCluster& cluster, std::size_t t) {
    const int first = cluster.hypotheses.front().branch_of[t];
    return std::all_of(cluster.hypotheses.begin(), cluster.hypotheses.end(),
                       [&](const Hypothesis& h) { return h.branch_of[t] == first; });
  }

  /// For each target the first one of its group, or kNobody for one that no hypothesis has.
  static std::vector<int> groups_of(const TrackCluster& cluster) {
    std::vector<int> parent(cluster.targets.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int t) {
      while (parent[t] != t) t = parent[t] = parent[parent[t]];
      return t;
    };
    std::map<std::pair<std::size_t, int>, int> taker;  // of a detection so many scans ago
    for (std::size_t t = 0; t < cluster.targets.size(); ++t) {
      if (is_agreed(cluster, t)) continue;
      for (const Hypothesis& h : cluster.hypotheses) {
        if (h.branch_of[t] == Hypothesis::kAbsent) continue;
        const auto& recent = cluster.targets[t].branches[h.branch_of[t]].recent;
        for (std::size_t age = 0; age < recent.size(); ++age) {
          if (recent[age] == 0) continue;
          const auto known = taker.try_emplace({age, recent[age]}, static_cast<int>(t)).first;
          const int a = root(known->second);
          const int b = root(static_cast<int>(t));
          parent[std::max(a, b)] = std::min(a, b);
        }
      }
    }
    std::vector<int> group(cluster.targets.size());
    for (std::size_t t = 0; t < group.size(); ++t) {
      const bool is_absent =
          is_agreed(cluster, t) && cluster.hypotheses.front().branch_of[t] == Hypothesis::kAbsent;
      group[t] = is_absent ? kNobody : root(static_cast<int>(t));
    }
    return group;
  }

  /// Some of the targets, with what the hypotheses say of them alone.
  static TrackCluster part_of(TrackCluster& cluster, const std::vector<std::size_t>& members) {
    TrackCluster part;
    std::map<std::vector<int>, std::size_t> known;
    std::vector<std::vector<int>> place;  // of each branch that is used
    for (const std::size_t t : members) {
      part.targets.push_back(
          {.birth = cluster.targets[t].birth, .id = cluster.targets[t].id, .branches = {}});
      place.emplace_back(cluster.targets[t].branches.size(), Hypothesis::kAbsent);
    }
    for (const Hypothesis& h : cluster.hypotheses) {
      Hypothesis own{.log_weight = h.log_weight, .branch_of = {}};
      for (std::size_t m = 0; m < members.size(); ++m) {
        int branch = h.branch_of[members[m]];
        if (branch != Hypothesis::kAbsent) {
          int& used = place[m][branch];
          if (used == Hypothesis::kAbsent) {
            used = static_cast<int>(part.targets[m].branches.size());
            part.targets[m].branches.push_back(
                std::move(cluster.targets[members[m]].branches[branch]));
          }
          branch = used;
        }
        own.branch_of.push_back(branch);
      }
      const auto [at, is_new] = known.try_emplace(own.branch_of, part.hypotheses.size());
      if (is_new) {
        part.hypotheses.push_back(std::move(own));
      } else {
        double& weight = part.hypotheses[at->second].log_weight;
        const double more = std::max(weight, own.log_weight);
        weight = more +
                 portable::log(portable::exp(weight - more) + portable::exp(own.log_weight - more));
      }
    }
    normalise(part.hypotheses);
    return part;
  }

  /// Detections that are in nobody's gate.
  void begin_alone() {
    if (real_ < look_.config().existence.drop) return;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (scene_of_[i] != kNobody) continue;
      TrackCluster& alone = state_.clusters.emplace_back();
      alone.targets.push_back(begin(static_cast<int>(i), real_));
      alone.hypotheses.push_back({.log_weight = 0.0, .branch_of = {0}});
    }
  }

  /// The tracks of the likeliest hypotheses.
  void report() {
    state_.tracks.clear();
    for (TrackCluster& cluster : state_.clusters) {
      const Hypothesis& likeliest = cluster.hypotheses.front();
      for (std::size_t t = 0; t < cluster.targets.size(); ++t) {
        if (likeliest.branch_of[t] == Hypothesis::kAbsent) continue;
        TrackTree& target = cluster.targets[t];
        Track& track = state_.tracks.emplace_back(target.branches[likeliest.branch_of[t]].track);
        track.birth = target.birth;
        track.id = target.id > 0 ? target.id : -target.birth;
        judge(look_.config(), track, state_.next_id);
        if (track.id > 0) target.id = track.id;
      }
    }
  }

  Look& look_;
  TrackerState& state_;
  const Evidence& evidence_;
  const std::vector<PlacedDetection>& members_;
  double nobodys_ = 0.0;       // density of detections that are no track's
  double real_ = 0.0;          // part of them that are of targets
  std::vector<Scene> scenes_;  // empty once joined to another
  std::vector<int> scene_of_;  // of each member: who may take it
};

}  // namespace

void step_by_hypotheses(Look& look, TrackerState& state) { MultiScan(look, state).run(); }

}  // namespace ghtrack
