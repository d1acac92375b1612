#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "scenes/schema/reader.hpp"
#include "sim/portable_math.hpp"
#include "tests/tools/run/listener.hpp"
#include "tools/run/run.hpp"

// Reference trajectories of the models in tests/reference/physics/MODELS.md, made independently of
// Box2D and of this project (DOP853 at a tolerance of 1e-12, each cross-checked by a second
// integrator), against the scenes in tests/reference/physics/scenes, which say the same.

namespace ghtrack {
namespace {

using nlohmann::json;

const std::filesystem::path kFolder =
    std::filesystem::path(GHTRACK_SOURCE_DIR) / "tests/reference/physics";

std::vector<std::string> scenario_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

json read_scenario(const std::string& name) {
  return json::parse(std::ifstream(kFolder / (name + ".json")));
}

WorldScene read_world_scene(const std::string& name, int physics_rate) {
  const std::vector<std::string> overrides{"physics.rate=" + std::to_string(physics_rate)};
  return std::get<WorldScene>(read_scene(kFolder / "scenes" / (name + ".yaml"), overrides));
}

/// A table by column.
using Table = std::map<std::string, std::vector<double>>;

Table read_table(const std::string& name) {
  std::ifstream file(kFolder / (name + ".csv"));
  std::string line;
  std::getline(file, line);
  std::vector<std::string> header;
  std::istringstream head(line);
  for (std::string cell; std::getline(head, cell, ',');) header.push_back(cell);
  Table table;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::string cell;
    for (const std::string& column : header) {
      std::getline(row, cell, ',');
      table[column].push_back(std::stod(cell));
    }
  }
  return table;
}

/// What a row of a table says of an object. Coupled cars are given by their displacements from
/// where they began; trains on a straight track by their place on it.
TruthState wanted_state(const Table& table, std::size_t row, const TruthState& began) {
  const auto cell = [&](const std::string& column) { return table.at(column)[row]; };
  const std::string car = std::to_string(began.id);
  TruthState state;
  if (table.contains("x" + car)) {
    state.position = began.position + Vec2(cell("x" + car), 0.0);
    state.velocity = Vec2(cell("v" + car), 0.0);
  } else if (table.contains("x")) {
    state.position = Vec2(cell("x"), cell("y"));
    state.velocity = Vec2(cell("vx"), cell("vy"));
  } else {
    state.position = Vec2(cell("s"), 0.0);
    state.velocity = Vec2(cell("v"), 0.0);
  }
  return state;
}

/// Largest deviations from a reference trajectory.
struct Deviation {
  double position = 0.0;
  double velocity = 0.0;
  double final_speed = 0.0;  // relative, in the end
  double lateral = 0.0;      // across the direction of travel
  double speed_lost = 0.0;   // of the reference's speed, relative

  void add(const TruthState& truth, const TruthState& wanted) {
    const Vec2 error = truth.position - wanted.position;
    const double speed = wanted.velocity.norm();
    position = std::max(position, error.norm());
    velocity = std::max(velocity, (truth.velocity - wanted.velocity).norm());
    if (speed == 0.0) return;
    const Vec2 forwards = wanted.velocity / speed;
    lateral = std::max(lateral, std::abs(error.y() * forwards.x() - error.x() * forwards.y()));
    final_speed = std::abs(truth.velocity.norm() / speed - 1.0);
    speed_lost = std::max(speed_lost, 1.0 - truth.velocity.norm() / speed);
  }
};

/// Runs a scene as the program does and compares the truth at its scans with the rows of the table,
/// which are thinned to every other scan or fewer.
Deviation deviation_from(const std::string& name, int physics_rate) {
  const WorldScene scene = read_world_scene(name, physics_rate);
  const Table table = read_table(name);
  SimulatedTruth source([&] { return make_world(scene); });
  const std::vector<double>& times = table.at("t");
  std::vector<TruthState> began;
  Deviation worst;
  std::size_t row = 0;
  Listener listener;
  listener.on_observation = [&](const TruthSnapshot& truth, const Observation&) {
    const std::vector<TruthState>& objects = truth.objects;
    if (began.empty()) began = objects;
    if (row == times.size() || truth.time < times[row] - 1e-9) return;
    ASSERT_NEAR(truth.time, times[row], 1e-9);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      worst.add(objects[i], wanted_state(table, row, began[i]));
    }
    ++row;
  };
  run(scene, source, {}, {&listener});
  EXPECT_EQ(row, times.size());
  return worst;
}

class Reference : public ::testing::TestWithParam<std::tuple<std::string, int>> {};

// Derived: the tolerances published with the trajectories; the kinematics of a train's track also
// hold their speed to 1e-4. In brackets what naive use of Box2D at 60 Hz gives.
// T4: baseball_drag, baseball_backspin_fly within 5 mm [0.67 m, 13 m].
// T7: tennis_topspin_bounce within 1 cm [4.9 m].
// T10: train_hs_coast within 0.5 m after 300 s, train_emu_coast_to_stop within 1 m [2161 m].
// T11: train_service_brake, train_emergency_brake [reversed to −25 m/s, 602 m].
// T13: track_clothoid_arc within 1 cm across and 5 cm along the track [3.3 m].
// T15: train_couplers_soft within 5 cm, train_couplers_slack within 10 cm.
// T16: balloon_still_rise within 1 % of the terminal speed.
// T17: balloon_gust_step within 2 cm [5 m with added mass, 41 m without].
// T19: balloon_rankine_vortex within 5 cm.
TEST_P(Reference, IsReproducedByItsScene) {
  const auto& [name, physics_rate] = GetParam();
  const json tolerance = read_scenario(name)["suggested_tolerance"];
  const Deviation worst = deviation_from(name, physics_rate);
  const auto limit = [&](const char* key) {
    return tolerance.value(key, std::numeric_limits<double>::infinity());
  };
  EXPECT_LE(worst.position, std::min(limit("pos"), limit("along")));
  EXPECT_LE(worst.velocity, limit("vel"));
  EXPECT_LE(worst.final_speed, limit("vel_rel"));
  EXPECT_LE(worst.lateral, limit("lateral"));
  if (name.starts_with("track_")) {
    EXPECT_LE(worst.speed_lost, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Physics, Reference,
                         ::testing::Combine(::testing::ValuesIn(scenario_names()),
                                            ::testing::Values(60, 240)),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_at_" +
                                  std::to_string(std::get<1>(test.param)) + "_Hz";
                         });

/// The scenarios with events.
std::vector<std::string> eventful_names() {
  std::vector<std::string> names = scenario_names();
  std::erase_if(names,
                [](const std::string& name) { return read_scenario(name)["events"].empty(); });
  return names;
}

class Events : public ::testing::TestWithParam<std::string> {};

// Derived: the instants of bounces and stops in the reference. By their tolerance before a bounce
// the ball still falls, as much later it rises; a train still moves, and then stands.
// T11: stop times within 0.1 s, and the trains stay.
TEST_P(Events, HappenWhenTheReferenceSays) {
  const json scenario = read_scenario(GetParam());
  const json& tolerance = scenario["suggested_tolerance"];
  World world = make_world(read_world_scene(GetParam(), 60));
  const auto state_at = [&](double time) { return world.sample(time).objects.at(0); };
  for (const json& event : scenario["events"]) {
    const double time = event["t"];
    if (event.value("type", "bounce") == "stop") {
      const double margin = tolerance["stop_t"];
      EXPECT_GT(state_at(time - margin).velocity.x(), 0.0);
      const TruthState stopped = state_at(time + margin);
      EXPECT_EQ(stopped.velocity.x(), 0.0);
      EXPECT_NEAR(stopped.position.x(), event["s"], tolerance["pos"].get<double>());
      EXPECT_EQ(state_at(time + 60.0).position, stopped.position);
    } else {
      const double margin = tolerance["bounce_t"];
      const TruthState falling = state_at(time - margin);
      const TruthState rising = state_at(time + margin);
      EXPECT_LT(falling.velocity.y(), 0.0) << time;
      EXPECT_GT(rising.velocity.y(), 0.0) << time;
      EXPECT_NEAR(rising.velocity.x(), event["v_out"][0], 0.02) << time;
      EXPECT_NEAR(rising.position.x(), event["x"].get<double>() + margin * rising.velocity.x(),
                  tolerance["pos"].get<double>())
          << time;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Physics, Events, ::testing::ValuesIn(eventful_names()),
                         [](const auto& test) { return test.param; });

// T6. Derived: with quadratic drag a ball that leaves the ground at v rises by ln(1 + k v²/g) / 2k,
// k = ρ C_d π r² / 2m. Every rebound of the tennis ball, within 0.5 % [9 cm].
TEST(TennisDrop, ReboundsToTheHeightsOfTheReference) {
  const json scenario = read_scenario("tennis_drop");
  const json& p = scenario["params"];
  const double radius = p["r"];
  const double gravity = p["g"];
  const double k = p["rho"].get<double>() * p["Cd"].get<double>() * portable::kPi * radius *
                   radius / (2.0 * p["m"].get<double>());
  World world = make_world(read_world_scene("tennis_drop", 60));
  const json& events = scenario["events"];
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {
    const double speed = events[i]["v_out"][1];
    const double wanted = std::log1p(k * speed * speed / gravity) / (2.0 * k);
    double highest = 0.0;
    for (double t = events[i]["t"]; t < events[i + 1]["t"]; t += 1e-3) {
      highest = std::max(highest, world.sample(t).objects.at(0).position.y() - radius);
    }
    EXPECT_NEAR(highest / wanted, 1.0, 0.005) << i;
  }
}

}  // namespace
}  // namespace ghtrack
