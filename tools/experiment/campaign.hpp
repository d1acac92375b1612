#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/schema/scene.hpp"
#include "sim/world.hpp"

namespace ghtrack {

/// One scene with one set of sweep values. Its seed is that of run 0, `compare.runs` says how many
/// runs there are, `compare.filters` what is compared.
struct CampaignCell {
  WorldScene scene;
  std::string file;   // that it was read from
  std::string sweep;  // "sensors[0].noise=0.3"; empty: the scene as it is

  int runs() const { return scene.compare.runs; }
};

/// A Monte Carlo campaign: every run of every cell. The result of a run depends on its cell and its
/// number alone, never on who computes it or when.
struct Campaign {
  std::vector<CampaignCell> cells;

  std::int64_t items() const;
};

/// What changes the scenes of a campaign.
struct CampaignOptions {
  std::vector<std::string> overrides;           // KEY=VALUE for every scene
  std::vector<std::string> sweeps;              // KEY=VALUE,VALUE,… instead of the scenes' sweeps
  std::map<std::string, FilterConfig> filters;  // instead of the scenes' filters, unless empty
  int runs = 0;                                 // instead of the scenes' runs, unless 0
};

/// Reads scenes and spells out their sweeps.
/// @throws SceneError for what is wrong with a scene or a sweep, InputError for a scene that is a
///         series
Campaign read_campaign(std::span<const std::string> files, const CampaignOptions& options);

/// The campaign as text from which read_back() makes it again: it identifies the campaign, and lets
/// parts of it be joined without its files.
std::string write_campaign(const Campaign& campaign);
/// @throws InputError if the text is not of a campaign
Campaign read_back(std::string_view text, const std::string& file);

/// The seed of a run: the scene's own for run 0, and for the others numbers below 2^53 that no
/// other run has, nor any run of a scene with another seed, but for chance (one pair in 10^16).
std::uint64_t seed_of_run(std::uint64_t seed, int run);

/// Runs of a scene that no campaign has, whatever its length: gains are tuned on the former and
/// judged on the latter.
inline constexpr int kFirstTuningRun = 1'000'000'000;
inline constexpr int kFirstJudgingRun = 2'000'000'000;

/// The scene of one run: its seed chooses the noise of the sensors.
WorldScene scene_of_run(const WorldScene& scene, int run);

/// Whether all runs of a scene have the same truth.
bool truth_is_fixed(const WorldScene& scene);

/// The world of one run, at its start: the scene's own, or one with other wind and other launches,
/// as `compare` says.
World world_of_run(const WorldScene& scene, int run);

}  // namespace ghtrack
