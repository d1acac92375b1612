// Fuzzing of the files of runs: what follows a sound header may be anything. A first byte of 1 asks
// for a record whose check sum is right whatever else is in it: it must be refused, or be fit for
// the tables that are made of it.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <variant>

#include "scenes/schema/reader.hpp"
#include "sim/random.hpp"
#include "tools/experiment/campaign.hpp"
#include "tools/experiment/journal.hpp"
#include "tools/experiment/run_table.hpp"
#include "tools/experiment/trial.hpp"
#include "tools/record/errors.hpp"

namespace {

namespace fs = std::filesystem;

/// A campaign of two runs, and a file of it that has no runs yet.
struct Sample {
  ghtrack::Campaign campaign = {
      {{std::get<ghtrack::WorldScene>(
            ghtrack::read_scene_text("duration: 1\ntargets: [{name: a, ball: {position: [0, 1]}}]\n"
                                     "sensors: [{rate: 10}]\ncompare: {runs: 2}\n",
                                     "sample.yaml")),
        "sample.yaml", ""}}};
  ghtrack::Trial trial{campaign.cells[0].scene};
  fs::path folder = fs::temp_directory_path() / ("ghtrack-fuzz-" + std::to_string(::getpid()));
  std::string header;

  Sample() {
    fs::create_directories(folder);
    ghtrack::Journal(folder, {}, campaign, false).complete();
    std::ifstream file(ghtrack::journal_path(folder, {}), std::ios::binary);
    header.assign(std::istreambuf_iterator<char>(file), {});
  }
  ~Sample() { fs::remove_all(folder); }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;
};

std::string with_check_sum(std::string record) {
  const std::uint64_t sum = ghtrack::check_sum(record);
  return record.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Sample sample;
  if (size == 0) return 0;
  const std::string rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const fs::path file = sample.folder / "shard-0-of-1.runs";
  std::ofstream(file, std::ios::binary)
      << sample.header << (data[0] == 1 ? with_check_sum(rest) : rest);
  ghtrack::Results results(sample.campaign);
  try {
    ghtrack::read_journals({file}, sample.campaign, results);
  } catch (const ghtrack::InputError&) {
    return 0;
  }
  for (int run = 0; run < 2; ++run) {
    if (!results.has(0, run)) continue;
    ghtrack::run_table_rows(sample.campaign.cells[0], sample.trial, run, results.at(0, run));
  }
  return 0;
}
