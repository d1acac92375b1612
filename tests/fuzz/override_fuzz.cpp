// Fuzzing of --set KEY=VALUE: none may crash the reader, and what is accepted can be written and
// read back.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tests/fuzz/scene_round_trip.hpp"

namespace {

constexpr std::string_view kScene = R"(
name: small
duration: 2
world: {wind: {mean: [1, 0]}, ground: {height: 0}, walls: [{from: [5, 0], to: [5, 3]}]}
targets:
  - {name: fly, ball: {type: baseball, position: [0, 1], velocity: [20, 15]}}
  - {name: tram, train: {track: [{straight: 200}], speed: 5}}
  - {name: party, balloon: {type: latex-11-inch, position: [6, 10]}}
sensors:
  - {name: camera, rate: 20, noise: 0.6, clutter: 1, field_of_view: [[-14, -3], [116, 57]]}
tracker: {filters: {ball: {ghk: {design: tracking-index, process_noise: 8}}, default: {gh: {g: 0.5, h: 0.1}}}}
video: {size: [320, 180]}
compare: {filters: {one: {gh: {g: 0.05, h: 0.001}}}}
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ghtrack::take_there_and_back(kScene, {std::string(reinterpret_cast<const char*>(data), size)});
  return 0;
}
