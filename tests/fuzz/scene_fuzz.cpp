// Fuzzing of scene texts: none may crash the reader, and an accepted one must survive being
// written.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/scene_round_trip.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ghtrack::take_there_and_back({reinterpret_cast<const char*>(data), size});
  return 0;
}
