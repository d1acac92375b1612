#include "tools/metrics/mot_benchmark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tools/metrics/box_frames.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack {
namespace {

constexpr std::int32_t kPedestrian = 1;
constexpr std::int32_t kLastClass = 13;
constexpr std::array<std::int32_t, 4> kDistractors = {2, 7, 8, 12};
constexpr std::int32_t kNonMotVehicle = 6;  // a distractor in MOT20

struct Name {
  MotBenchmark benchmark;
  std::string_view name;
};
constexpr std::array<Name, 5> kNames = {{{MotBenchmark::kNone, "none"},
                                         {MotBenchmark::kMot15, "MOT15"},
                                         {MotBenchmark::kMot16, "MOT16"},
                                         {MotBenchmark::kMot17, "MOT17"},
                                         {MotBenchmark::kMot20, "MOT20"}}};

bool has_classes(MotBenchmark benchmark) {
  return benchmark != MotBenchmark::kNone && benchmark != MotBenchmark::kMot15;
}

bool is_distractor(MotBenchmark benchmark, std::int32_t category) {
  return std::find(kDistractors.begin(), kDistractors.end(), category) != kDistractors.end() ||
         (benchmark == MotBenchmark::kMot20 && category == kNonMotVehicle);
}

bool is_scored(MotBenchmark benchmark, const MotRow& row) {
  return row.confidence != 0.0 && (!has_classes(benchmark) || row.category == kPedestrian);
}

/// Which boxes of tracks match a distractor of the truth.
std::vector<bool> on_distractors(MotBenchmark benchmark, std::span<const MotRow> truth,
                                 std::span<const MotRow> tracks) {
  std::vector<bool> result(tracks.size(), false);
  if (!has_classes(benchmark)) return result;
  const auto matches = same_boxes(truth, tracks);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    result[i] = matches[i] && is_distractor(benchmark, truth[*matches[i]].category);
  }
  return result;
}

void refuse_other_classes(std::span<const MotRow> tracks) {
  const auto other = std::find_if(tracks.begin(), tracks.end(), [](const MotRow& row) {
    return row.category > kPedestrian && row.category <= kLastClass;
  });
  if (other == tracks.end()) return;
  throw InputError(
      fmt::format("the tracks have a box of class {} in frame {}; the benchmark is of pedestrians, "
                  "class 1; --benchmark none scores every class",
                  other->category, other->frame));
}

/// What the rows of the truth were, so that it can be said why none of them is scored.
class TruthCounts {
 public:
  explicit TruthCounts(MotBenchmark benchmark) : benchmark_(benchmark) {}

  void add(const MotRow& row) {
    ++rows_;
    scored_ += is_scored(benchmark_, row) ? 1 : 0;
    ++(row.confidence == 0.0 ? flagged_ : by_class_[row.category]);
  }

  /// @throws InputError if there is truth but none of it is scored
  void check(const std::string& name) const {
    if (rows_ == 0 || scored_ > 0) return;
    throw InputError(
        fmt::format("{}: error: none of its {} rows is scored under the rules of {} ({}){}", name,
                    rows_, to_string(benchmark_), reasons(),
                    has_classes(benchmark_) ? "; --benchmark none scores every class" : ""));
  }

 private:
  std::string reasons() const {
    std::string text = flagged_ > 0 ? fmt::format("{} with confidence 0", flagged_) : "";
    for (const auto& [category, count] : by_class_) {
      text += fmt::format("{}{} of class {}", text.empty() ? "" : ", ", count, category);
    }
    return text;
  }

  MotBenchmark benchmark_;
  std::int64_t rows_ = 0, scored_ = 0, flagged_ = 0;
  std::map<std::int32_t, std::int64_t> by_class_;
};

}  // namespace

std::string_view to_string(MotBenchmark benchmark) {
  return kNames[static_cast<std::size_t>(benchmark)].name;
}

std::optional<MotBenchmark> benchmark_named(std::string_view name) {
  for (const Name& known : kNames) {
    if (known.name == name) return known.benchmark;
  }
  return std::nullopt;
}

MotBenchmark recognise_benchmark(const std::filesystem::path& path, bool has_categories) {
  if (!has_categories) return MotBenchmark::kMot15;
  const std::string text = path.string();
  for (const Name& known : kNames) {
    if (!has_classes(known.benchmark)) continue;
    if (text.find(known.name) != std::string::npos) return known.benchmark;
  }
  return MotBenchmark::kMot17;
}

ScoreResult score_boxes(MotBenchmark benchmark, const std::string& truth_name,
                        const BoxSource& truth, const BoxSource& tracks,
                        const ScoreOptions& options, const OnBoxStep& on_step) {
  TruthCounts counts(benchmark);
  const auto select = [&](std::span<const MotRow> truth_now, std::span<const MotRow> tracks_now) {
    if (has_classes(benchmark)) refuse_other_classes(tracks_now);
    BoxSelection selection;
    for (const MotRow& row : truth_now) {
      counts.add(row);
      selection.truth.push_back(is_scored(benchmark, row));
    }
    selection.tracks = on_distractors(benchmark, truth_now, tracks_now);
    selection.tracks.flip();
    return selection;
  };
  ScoreResult result = score_box_frames(truth, tracks, options, select, on_step);
  counts.check(truth_name);
  result.benchmark = to_string(benchmark);
  return result;
}

}  // namespace ghtrack
