#include "sim/target.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "sim/random.hpp"

namespace ghtrack {
namespace {

bool is_block(const Target& target) { return target.grid || target.random || target.repeat; }

std::size_t copies_of(const Target& target) {
  const auto size = [](int count) { return static_cast<std::size_t>(count); };
  std::size_t copies = 1;
  if (target.grid) copies *= size(target.grid->columns) * size(target.grid->rows);
  if (target.random) copies *= size(target.random->count);
  if (target.repeat) copies *= size(target.repeat->count);
  return copies;
}

void move(Target& target, const Vec2& shift) {
  std::visit([&](auto& motion) { motion.shift(shift); }, target.motion);
}

void delay(Target& target, double time) {
  target.appears += time;
  if (target.disappears) *target.disappears += time;
}

std::vector<Target> on_grid(const Target& target) {
  if (!target.grid) return {target};
  std::vector<Target> copies;
  for (int row = 0; row < target.grid->rows; ++row) {
    for (int column = 0; column < target.grid->columns; ++column) {
      move(copies.emplace_back(target), target.grid->spacing.cwiseProduct(Vec2(column, row)));
    }
  }
  return copies;
}

/// A copy's random numbers depend on its block's name, its place in the grid and its number alone.
std::vector<Target> scattered(const Target& target, std::size_t place) {
  if (!target.random) return {target};
  const RandomCopies& random = *target.random;
  const std::uint64_t block = combine(key_of(kind_of(target.motion)), key_of(target.name));
  std::vector<Target> copies;
  for (int i = 0; i < random.count; ++i) {
    Stream stream(random.seed, Purpose::kLaunch, combine(block, place),
                  static_cast<std::uint64_t>(i));
    const double x = stream.uniform() - 0.5;
    const double y = stream.uniform() - 0.5;
    const double change_x = 2.0 * stream.uniform() - 1.0;
    const double change_y = 2.0 * stream.uniform() - 1.0;
    const double later = stream.uniform();
    Target& copy = copies.emplace_back(target);
    move(copy, random.area.cwiseProduct(Vec2(x, y)));
    std::visit(
        [&](auto& motion) {
          motion.hasten(random.velocity.cwiseProduct(Vec2(change_x, change_y)));
        },
        copy.motion);
    delay(copy, random.within * later);
  }
  return copies;
}

std::vector<Target> repeated(const Target& target) {
  if (!target.repeat) return {target};
  std::vector<Target> copies;
  for (int i = 0; i < target.repeat->count; ++i) {
    Target& copy = copies.emplace_back(target);
    move(copy, i * target.repeat->shift);
    delay(copy, i * target.repeat->every);
  }
  return copies;
}

std::vector<Target> copies_spelled_out(const Target& target) {
  if (!is_block(target)) return {target};
  std::vector<Target> all;
  std::size_t place = 0;
  for (const Target& at : on_grid(target)) {
    for (const Target& one : scattered(at, place++)) {
      for (Target& copy : repeated(one)) {
        copy.grid.reset();
        copy.random.reset();
        copy.repeat.reset();
        if (!copy.name.empty()) copy.name += " " + std::to_string(all.size() + 1);
        all.push_back(std::move(copy));
      }
    }
  }
  return all;
}

/// The targets one by one, and for each the entry of the list that it comes from.
struct Spelled {
  std::vector<Target> targets;
  std::vector<std::size_t> entries;
};

Spelled spell(const std::vector<Target>& targets) {
  Spelled result;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (result.targets.size() + copies_of(targets[i]) > kMostTargets) break;
    for (Target& copy : copies_spelled_out(targets[i])) {
      result.targets.push_back(std::move(copy));
      result.entries.push_back(i);
    }
  }
  name_targets(result.targets);
  return result;
}

/// Where a round target that gives way begins.
struct Beginning {
  std::size_t target;
  double appears;
  Vec2 position;
  double radius;
};

std::vector<Beginning> beginnings_of(const std::vector<Target>& targets) {
  std::vector<Beginning> beginnings;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].released_by) continue;
    std::visit(
        [&]<class R>(const R& motion) {
          if constexpr (IsRoundModel<typename R::Model>) {
            const Outline outline = typename R::Model(motion).contact().outline;
            beginnings.push_back({i, targets[i].appears, motion.position, 0.5 * outline.length});
          }
        },
        targets[i].motion);
  }
  return beginnings;
}

class ProblemFinder {
 public:
  ProblemFinder(const std::vector<Target>& listed, const EnvironmentConfig& environment)
      : spelled_(spell(listed)), targets_(spelled_.targets), environment_(environment) {
    std::size_t total = 0;
    for (std::size_t i = 0; i < listed.size(); ++i) {
      total += copies_of(listed[i]);
      if (total <= kMostTargets) continue;
      problems_.push_back({i, "makes " + std::to_string(total) + " targets in all; at most " +
                                  std::to_string(kMostTargets) + " are possible"});
      break;
    }
  }

  std::vector<TargetProblem> find() && {
    find_equal_names();
    find_overlaps();
    find_bodies_in_solids();
    find_impossible_releases();
    return std::move(problems_);
  }

 private:
  /// One message for each entry of the list is enough, however many copies it makes.
  void report(std::size_t target, const std::string& message) {
    const std::size_t entry = spelled_.entries[target];
    if (!problems_.empty() && problems_.back().target == entry) return;
    problems_.push_back({entry, message});
  }

  void find_equal_names() {
    std::set<std::string> names;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (names.insert(targets_[i].name).second) continue;
      report(i, "the name '" + targets_[i].name + "' is taken: names must be unique");
    }
  }

  /// Bodies that begin inside each other would be flung apart, and many of them stop Box2D for
  /// good.
  void find_overlaps() {
    std::vector<Beginning> beginnings = beginnings_of(targets_);
    if (beginnings.empty()) return;
    // A sweep along the axis on which they are farther apart.
    Vec2 low = beginnings.front().position;
    Vec2 high = low;
    for (const Beginning& one : beginnings) {
      low = low.cwiseMin(one.position);
      high = high.cwiseMax(one.position);
    }
    const int axis = high.y() - low.y() > high.x() - low.x() ? 1 : 0;
    const auto begin_of = [axis](const Beginning& one) { return one.position[axis] - one.radius; };
    std::sort(beginnings.begin(), beginnings.end(), [&](const Beginning& a, const Beginning& b) {
      return std::pair(begin_of(a), a.target) < std::pair(begin_of(b), b.target);
    });
    for (std::size_t i = 0; i < beginnings.size(); ++i) {
      const Beginning& a = beginnings[i];
      for (std::size_t j = i + 1; j < beginnings.size(); ++j) {
        const Beginning& b = beginnings[j];
        if (begin_of(b) > a.position[axis] + a.radius) break;
        if (a.appears != b.appears) continue;
        if ((a.position - b.position).norm() >= 0.9 * (a.radius + b.radius)) continue;
        const auto [first, second] = std::minmax({a.target, b.target});
        report(second, "begins inside " + place_of(first, spelled_.entries[second]) +
                           ": place them apart or let one appear later");
        break;
      }
    }
  }

  std::string place_of(std::size_t target, std::size_t seen_from) const {
    const std::size_t entry = spelled_.entries[target];
    if (entry == seen_from) return "another of its copies";
    return "targets[" + std::to_string(entry) + "]";
  }

  void find_bodies_in_solids() {
    for (const Beginning& beginning : beginnings_of(targets_)) {
      const Vec2& position = beginning.position;
      if (environment_.ground && position.y() < environment_.ground->height_at(position.x())) {
        report(beginning.target, "begins below the ground");
      }
      for (const SolidBox& box : environment_.boxes) {
        if (box.contains(position)) report(beginning.target, "begins inside a box");
      }
    }
  }

  void find_impossible_releases() {
    std::map<std::string_view, const Target*> by_name;
    for (const Target& target : targets_) by_name.emplace(target.name, &target);
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      const Target& target = targets_[i];
      if (!target.released_by) continue;
      const auto carrier = by_name.find(*target.released_by);
      if (carrier == by_name.end()) {
        report(i, "no target is called '" + *target.released_by + "', which should release it");
      } else if (!is_there(*carrier->second, target)) {
        report(i, "'" + *target.released_by + "' is not there yet, or not any more, to release it");
      }
    }
  }

  /// Whether the carrier is under way when it should release the target.
  static bool is_there(const Target& carrier, const Target& target) {
    const double end = carrier.disappears.value_or(std::numeric_limits<double>::infinity());
    return target.appears < end && (carrier.appears < target.appears ||
                                    (carrier.appears == target.appears && !carrier.released_by));
  }

  Spelled spelled_;
  const std::vector<Target>& targets_;
  const EnvironmentConfig& environment_;
  std::vector<TargetProblem> problems_;
};

}  // namespace

void name_targets(std::vector<Target>& targets) {
  std::set<std::string> taken;
  for (const Target& target : targets) taken.insert(target.name);
  std::map<std::string_view, int> numbers;  // of each kind so far
  for (Target& target : targets) {
    const std::string_view kind = kind_of(target.motion);
    const int number_of_kind = ++numbers[kind];
    if (!target.name.empty() || is_block(target)) continue;
    int number = number_of_kind;
    const auto name = [&] { return std::string(kind) + " " + std::to_string(number); };
    while (taken.contains(name())) ++number;
    target.name = name();
    taken.insert(target.name);
  }
}

std::vector<Target> spell_out(const std::vector<Target>& targets) { return spell(targets).targets; }

std::vector<Target> scatter_launches(const std::vector<Target>& targets,
                                     const LaunchScatter& scatter, std::uint64_t seed,
                                     const EnvironmentConfig& environment) {
  constexpr std::uint64_t kMostDraws = 100;
  const std::vector<Target> intended = spell_out(targets);
  std::vector<Target> scattered = intended;
  std::vector<std::size_t> waiting(intended.size());  // targets without a good start yet
  std::iota(waiting.begin(), waiting.end(), std::size_t{0});
  for (std::uint64_t draw = 0; draw < kMostDraws && !waiting.empty(); ++draw) {
    for (const std::size_t i : waiting) {
      Stream stream(seed, Purpose::kLaunch, key_of(intended[i].name), draw);
      const double x = stream.normal();
      const double y = stream.normal();
      const double change_x = stream.normal();
      const double change_y = stream.normal();
      scattered[i] = intended[i];
      move(scattered[i], scatter.position * Vec2(x, y));
      std::visit([&](auto& motion) { motion.hasten(scatter.velocity * Vec2(change_x, change_y)); },
                 scattered[i].motion);
    }
    waiting.clear();
    for (const TargetProblem& problem : find_problems(scattered, environment)) {
      waiting.push_back(problem.target);
    }
  }
  return scattered;
}

std::vector<TargetProblem> find_problems(const std::vector<Target>& targets,
                                         const EnvironmentConfig& environment) {
  return ProblemFinder(targets, environment).find();
}

}  // namespace ghtrack
