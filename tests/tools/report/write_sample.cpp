// Writes the report of a made-up comparison, to be looked at and to be tested in a browser:
// write_sample_report FILE.html [SCENES]

#include <cstdlib>
#include <fstream>

#include "tests/tools/report/synthetic_comparison.hpp"
#include "tools/report/report.hpp"

int main(int count, char** arguments) {
  if (count < 2) return 2;
  const std::size_t scenes = count > 2 ? std::strtoul(arguments[2], nullptr, 10) : 3;
  std::ofstream file(arguments[1], std::ios::binary);
  file << ghtrack::comparison_report(
      ghtrack::testing::synthetic_comparison(scenes),
      {.introduction = "Made-up numbers.", .videos = {{0, "all filters & <more>", "scene 1.mp4"}}});
  file.close();
  return file ? 0 : 1;
}
