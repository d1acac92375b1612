// The one-way dependencies of the architecture, checked over every #include of the tree.

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Folders = std::vector<std::string>;

/// What each folder may include, beside itself. A file of a longer path obeys the longest match.
const std::map<std::string, Folders> kAllowed = {
    {"sim", {}},
    {"tracker", {"sensors/detection.hpp", "sensors/field_of_view.hpp", "sim/portable_math.hpp"}},
    {"tracker/filters", {"sensors/measurement.hpp", "sim/portable_math.hpp"}},
    {"tracker/filters/filter.hpp",
     {"tracker/filters", "sensors/detection.hpp", "sim/portable_math.hpp"}},
    {"sensors/detection.hpp", {"sensors/field_of_view.hpp", "sensors/measurement.hpp"}},
    {"sensors/field_of_view.hpp", {}},
    {"sensors", {"sim/plane.hpp", "sim/truth.hpp", "sim/random.hpp", "sim/portable_math.hpp"}},
    {"scenes/schema", {"sim", "sensors", "tracker"}},
    {"tools/record", {"sim/truth.hpp", "sensors", "tracker", "scenes/schema/utf8.hpp"}},
    {"tools/data", {"tools/record", "scenes/schema/diagnostic.hpp", "sensors"}},
    {"tools/metrics",
     {"tools/record", "tools/data", "sim/portable_math.hpp", "sim/truth.hpp", "sim/random.hpp",
      "sensors", "tracker", "scenes/schema/utf8.hpp"}},
    {"tools/run", {"tools/record", "tools/data", "scenes", "sim", "sensors", "tracker"}},
    {"tools/python",
     {"tools/run", "tools/metrics", "tools/record", "tools/experiment/hindsight.hpp",
      "tools/data/words.hpp", "scenes/schema", "tracker"}},
    {"tools/modules", {}},
    {"tools/ranks", {"tools/modules"}},
    {"tools/render",
     {"tools/record", "tools/modules", "sim/truth.hpp", "sim/surface.hpp", "sensors", "tracker",
      "scenes/schema/utf8.hpp", "scenes/schema/video_corner.hpp", "scenes/schema/video_layer.hpp",
      "scenes/schema/video_theme.hpp"}},
    {"tools/film",
     {"tools/run", "tools/metrics", "tools/record", "tools/render", "scenes", "sim", "sensors",
      "tracker"}},
    {"tools/page",
     {"tools/film", "tools/html", "tools/metrics", "tools/run", "tools/record", "tools/render",
      "scenes", "sim", "sensors", "tracker"}},
    {"tools/experiment",
     {"tools/run", "tools/metrics", "tools/record", "scenes", "sim", "sensors", "tracker"}},
    {"tools/plot", {"tools/metrics", "tools/data", "tools/record", "tracker"}},
    {"tools/html", {}},
    {"tools/playground", {"tools/html", "tools/run/series.hpp", "tracker/filters"}},
    {"tools/report",
     {"tools/html", "tools/playground", "tools/experiment", "tools/metrics", "tools/record",
      "scenes", "tracker"}},
    {"tools/cli", {"tools", "scenes", "sim", "sensors", "tracker"}},
    {"tools/bench", {"tools", "scenes", "sim", "sensors", "tracker"}},
};

/// The only folders or files that may include a library's headers.
const std::map<std::string, Folders> kOwners = {
    {"box2d/", {"sim/neighbours.cpp", "tools/bench"}},
    {"opencv2/", {"tools/render", "tools/bench"}},
    {"yaml-cpp/", {"scenes/schema"}},
    {"CLI/", {"tools/cli"}},
    {"kainjow/", {"tools/html/template.cpp"}},
    {"Random123/", {"sim/random.cpp"}},
    {"mpi.h", {"tools/ranks/mpi_module.cpp"}},
    {"cairo", {"tools/plot"}},
    {"coin/", {"tools/metrics/trajectory_gospa.cpp"}},
    {"GeographicLib/", {"tools/data/place.cpp"}},
    {"pugixml", {"tools/data/formats.cpp"}},
    {"nlopt", {"tools/experiment/gain_search.cpp"}},
    {"utf8.h", {"scenes/schema/utf8.hpp", "tools/render/font.cpp"}},
    {"nettle/", {"tools/html/digest.cpp"}},
    {"oneapi/tbb/", {"tools/experiment/engine.cpp", "tools/render"}},
};

bool starts_with_any(const std::string& path, const Folders& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return path.rfind(prefix, 0) == 0; });
}

std::string layer_of(const std::string& path) {
  std::string best;
  for (const auto& [layer, allowed] : kAllowed) {
    if (path.rfind(layer, 0) == 0 && layer.size() > best.size()) best = layer;
  }
  return best;
}

bool is_allowed(const std::string& file, const std::string& included) {
  for (const auto& [library, owners] : kOwners) {
    if (included.rfind(library, 0) == 0) return starts_with_any(file, owners);
  }
  const std::string target = layer_of(included);
  if (target.empty()) return true;  // the standard library and unrestricted libraries
  const std::string layer = layer_of(file);
  return included.rfind(layer + "/", 0) == 0 || starts_with_any(included, kAllowed.at(layer));
}

std::vector<std::string> forbidden_includes(const fs::path& root, const std::string& folder) {
  static const std::regex include(R"(^\s*#include\s+[<"]([^>"]+)[>"])");
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".hpp" && extension != ".cpp") continue;
    const std::string file = fs::relative(entry.path(), root).string();
    std::ifstream text(entry.path());
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
      if (std::regex_search(line, match, include) && !is_allowed(file, match[1])) {
        found.push_back(file + " includes " + match[1].str());
      }
    }
  }
  return found;
}

// Property: holds for every source file of the project.
TEST(Layers, NoFolderIncludesWhatItMustNotKnow) {
  for (const char* folder : {"sim", "sensors", "tracker", "scenes", "tools"}) {
    EXPECT_THAT(forbidden_includes(GHTRACK_SOURCE_DIR, folder), ::testing::IsEmpty());
  }
}

/// The files below a folder that mention a word.
std::vector<std::string> files_with(const fs::path& root, const std::string& folder,
                                    const std::regex& word) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream text(entry.path());
    for (std::string line; std::getline(text, line);) {
      if (!std::regex_search(line, word)) continue;
      found.push_back(fs::relative(entry.path(), root).string());
      break;
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Property: who made a detection is the business of those who score and show, and of the decorator
// for known association; a tracker has no way of being told.
TEST(Layers, TheTrackerIsNeverToldWhoMadeADetection) {
  const std::regex origin(R"(\borigins?\b|\bidentit|\bObjectId\b|\bObservation\b)");
  EXPECT_THAT(files_with(GHTRACK_SOURCE_DIR, "tracker", origin), ::testing::IsEmpty());
  EXPECT_THAT(files_with(GHTRACK_SOURCE_DIR, "tools/run", std::regex(R"(\borigins\b)")),
              ::testing::ElementsAre("tools/run/known_association.cpp"));
}

// Derived: the rules themselves, on made-up includes.
TEST(Layers, TheRulesTellAllowedFromForbidden) {
  EXPECT_TRUE(is_allowed("tracker/gate.cpp", "sensors/detection.hpp"));
  EXPECT_TRUE(is_allowed("tracker/gate.cpp", "tracker/filters/filter.hpp"));
  EXPECT_FALSE(is_allowed("tracker/filters/gh.hpp", "tracker/track.hpp"));
  EXPECT_FALSE(is_allowed("tracker/gate.cpp", "sim/truth.hpp"));
  EXPECT_FALSE(is_allowed("tracker/gate.cpp", "sensors/observation.hpp"));
  EXPECT_TRUE(is_allowed("sim/neighbours.cpp", "box2d/box2d.h"));
  EXPECT_FALSE(is_allowed("sim/world.cpp", "box2d/box2d.h"));
  EXPECT_FALSE(is_allowed("sim/world.cpp", "sensors/detection.hpp"));
  EXPECT_FALSE(is_allowed("tools/metrics/gospa.cpp", "scenes/schema/scene.hpp"));
  EXPECT_FALSE(is_allowed("tools/cli/main.cpp", "opencv2/core.hpp"));
}

}  // namespace
