#include "tools/experiment/campaign.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "scenes/schema/reader.hpp"
#include "scenes/schema/writer.hpp"
#include "sim/random.hpp"
#include "tools/record/csv_writer.hpp"
#include "tools/record/errors.hpp"
#include "tools/run/truth_source.hpp"

namespace ghtrack {
namespace {

using Json = nlohmann::ordered_json;

/// A key with the values that it takes.
struct Sweep {
  std::string key;
  std::vector<std::string> values;
};

std::vector<Sweep> sweeps_of(const CompareConfig& compare) {
  std::vector<Sweep> sweeps;
  for (const auto& [key, values] : compare.sweep) {
    Sweep& sweep = sweeps.emplace_back(Sweep{key, {}});
    for (const double value : values) append_number(sweep.values.emplace_back(), value);
  }
  return sweeps;
}

Sweep parse_sweep(const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  Sweep sweep{text.substr(0, equals), {}};
  for (std::size_t from = equals + 1; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    sweep.values.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  const bool has_gaps =
      std::find(sweep.values.begin(), sweep.values.end(), "") != sweep.values.end();
  if (sweep.key.empty() || sweep.values.empty() || has_gaps) {
    throw InputError("--sweep '" + text +
                     "': error: wanted is KEY=VALUE,VALUE,…, such as "
                     "sensors[0].noise=0.3,1,3");
  }
  return sweep;
}

/// Every combination of the sweeps' values, the last key changing fastest, as "KEY=VALUE" each.
std::vector<std::vector<std::string>> combinations(const std::vector<Sweep>& sweeps) {
  std::vector<std::vector<std::string>> all = {{}};
  for (const Sweep& sweep : sweeps) {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& settings : all) {
      for (const std::string& value : sweep.values) {
        longer.push_back(settings);
        longer.back().push_back(sweep.key + "=" + value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::string joined(const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& setting : settings) text += (text.empty() ? "" : ", ") + setting;
  return text;
}

WorldScene read_world(const std::string& file, const std::vector<std::string>& overrides) {
  Scene scene = read_scene(file, overrides);
  if (WorldScene* world = std::get_if<WorldScene>(&scene)) return std::move(*world);
  throw InputError(file +
                   ": error: is a series of numbers, which `ghtrack run` filters; campaigns "
                   "need a world");
}

}  // namespace

std::int64_t Campaign::items() const {
  std::int64_t items = 0;
  for (const CampaignCell& cell : cells) items += cell.runs();
  return items;
}

Campaign read_campaign(std::span<const std::string> files, const CampaignOptions& options) {
  std::vector<Sweep> given;
  for (const std::string& text : options.sweeps) given.push_back(parse_sweep(text));
  Campaign campaign;
  for (const std::string& file : files) {
    const WorldScene scene = read_world(file, options.overrides);
    for (const CampaignCell& other : campaign.cells) {
      if (other.scene.name != scene.name) continue;
      throw InputError(file + ": error: this scene and that of " + other.file +
                       " have the same name, '" + scene.name +
                       "': nobody could tell their results apart");
    }
    for (const auto& settings : combinations(given.empty() ? sweeps_of(scene.compare) : given)) {
      std::vector<std::string> overrides = options.overrides;
      overrides.insert(overrides.end(), settings.begin(), settings.end());
      CampaignCell& cell = campaign.cells.emplace_back();
      cell.scene = settings.empty() ? scene : read_world(file, overrides);
      cell.scene.compare.sweep.clear();
      if (!options.filters.empty()) {
        cell.scene.compare.filters = options.filters;
        cell.scene.compare.tuned.clear();
        cell.scene.compare.order.clear();
      }
      if (options.runs > 0) cell.scene.compare.runs = options.runs;
      cell.file = file;
      cell.sweep = joined(settings);
    }
  }
  return campaign;
}

std::string write_campaign(const Campaign& campaign) {
  Json cells = Json::array();
  for (const CampaignCell& cell : campaign.cells) {
    cells.push_back(
        {{"file", cell.file}, {"sweep", cell.sweep}, {"scene", write_scene(cell.scene)}});
  }
  const Json campaign_json = {{"ghtrack", GHTRACK_VERSION}, {"cells", std::move(cells)}};
  return campaign_json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Campaign read_back(std::string_view text, const std::string& file) try {
  const Json json = Json::parse(text);
  if (json.at("ghtrack") != GHTRACK_VERSION) {
    throw InputError(file + ": error: was not written by version " GHTRACK_VERSION " of ghtrack");
  }
  Campaign campaign;
  for (const Json& cell : json.at("cells")) {
    Scene scene = read_scene_text(cell.at("scene").get<std::string>(), file);
    campaign.cells.push_back({std::get<WorldScene>(std::move(scene)),
                              cell.at("file").get<std::string>(),
                              cell.at("sweep").get<std::string>()});
  }
  return campaign;
} catch (const Json::exception&) {
  throw InputError(file + ": error: does not say which campaign its runs are of");
}

std::uint64_t seed_of_run(std::uint64_t seed, int run) {
  constexpr int kExactInDoubles = 53;  // bits, so that every reader of a table gets the same seed
  if (run == 0) return seed;
  Stream stream(seed, Purpose::kResampling, 0, static_cast<std::uint64_t>(run));
  return stream.bits() >> (64 - kExactInDoubles);
}

WorldScene scene_of_run(const WorldScene& scene, int run) {
  WorldScene changed = scene;
  changed.seed = seed_of_run(scene.seed, run);
  return changed;
}

bool truth_is_fixed(const WorldScene& scene) {
  return !scene.compare.fresh_wind && !scene.compare.launch;
}

World world_of_run(const WorldScene& scene, int run) {
  WorldScene changed = scene;
  if (scene.compare.fresh_wind) changed.seed = seed_of_run(scene.seed, run);
  if (scene.compare.launch) {
    changed.targets = scatter_launches(scene.targets, *scene.compare.launch,
                                       seed_of_run(scene.seed, run), scene.environment);
  }
  return make_world(changed);
}

}  // namespace ghtrack
