#include "tools/cli/score_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>

#include "tools/cli/paths.hpp"
#include "tools/cli/usage_error.hpp"
#include "tools/record/errors.hpp"

namespace ghtrack::cli {
namespace {

namespace fs = std::filesystem;

std::string name_of_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::absolute(folder, ignored).lexically_normal().filename().empty()
             ? fs::absolute(folder, ignored).lexically_normal().parent_path().filename().string()
             : fs::absolute(folder, ignored).lexically_normal().filename().string();
}

/// "MOT17-09" of …/MOT17-09/gt/gt.txt, the folder's name of …/truth.csv, else the file's own name.
std::string name_of_file(const fs::path& file) {
  if (file.filename() == "gt.txt" && file.parent_path().filename() == "gt") {
    return name_of_folder(file.parent_path().parent_path());
  }
  const bool generic = file.filename() == "truth.csv" || file.filename() == "gt.txt";
  return generic ? name_of_folder(file.parent_path()) : file.stem().string();
}

/// Where the tracks of a sequence or run are.
std::string tracks_of(const fs::path& tracks, const std::string& name) {
  if (!is_folder(tracks)) return tracks.string();
  const fs::path candidates[] = {tracks / (name + ".txt"), tracks / "data" / (name + ".txt"),
                                 tracks / "tracks.csv", tracks / name / "tracks.csv"};
  for (const fs::path& candidate : candidates) {
    if (is_there(candidate)) return candidate.string();
  }
  throw InputError(
      fmt::format("{}: error: there are no tracks of '{}': neither {}.txt nor "
                  "tracks.csv",
                  tracks.string(), name, name));
}

void add_pairs(const fs::path& truth, const fs::path& tracks, std::vector<ScorePair>& pairs) {
  const auto add = [&](const fs::path& file, const std::string& name) {
    pairs.push_back({name, file.string(), tracks_of(tracks, name)});
  };
  if (!is_folder(truth)) return add(truth, name_of_file(truth));
  const std::string name = name_of_folder(truth);
  if (is_there(truth / "gt" / "gt.txt")) return add(truth / "gt" / "gt.txt", name);
  if (is_there(truth / "truth.csv")) return add(truth / "truth.csv", name);
  std::vector<fs::path> sequences;
  for (const auto& entry : fs::directory_iterator(truth)) {
    if (is_there(entry.path() / "gt" / "gt.txt")) sequences.push_back(entry.path());
  }
  if (sequences.empty()) {
    throw InputError(
        fmt::format("{}: error: the folder holds neither truth.csv, nor gt/gt.txt, nor sequences "
                    "with gt/gt.txt",
                    truth.string()));
  }
  std::sort(sequences.begin(), sequences.end());
  for (const fs::path& sequence : sequences) {
    add(sequence / "gt" / "gt.txt", sequence.filename().string());
  }
}

/// Adds the names of their tracks to those of pairs that share one, and numbers if that is not
/// enough.
void tell_apart(std::vector<ScorePair>& pairs) {
  const auto shared = [&pairs] {
    std::map<std::string, int> count;
    for (const ScorePair& pair : pairs) ++count[pair.name];
    std::erase_if(count, [](const auto& name) { return name.second == 1; });
    return count;
  };
  const auto of_one_name = shared();
  for (ScorePair& pair : pairs) {
    if (of_one_name.contains(pair.name)) pair.name += "/" + fs::path(pair.tracks).stem().string();
  }
  std::map<std::string, int> numbers;
  const auto still = shared();
  for (ScorePair& pair : pairs) {
    if (still.contains(pair.name)) pair.name += fmt::format(" {}", ++numbers[pair.name]);
  }
}

}  // namespace

std::vector<ScorePair> pairs_to_score(const ScoreOptions& options) {
  if (options.truth.size() != options.tracks.size()) {
    throw UsageError(
        fmt::format("score: --truth names {} files and --tracks {}; as many are needed",
                    options.truth.size(), options.tracks.size()));
  }
  std::vector<ScorePair> pairs;
  for (std::size_t i = 0; i < options.truth.size(); ++i) {
    add_pairs(options.truth[i], options.tracks[i], pairs);
  }
  tell_apart(pairs);
  return pairs;
}

}  // namespace ghtrack::cli
