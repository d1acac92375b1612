#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "tools/experiment/campaign.hpp"
#include "tools/record/number_file.hpp"

// What the runs of a campaign have yielded. A study may have a million runs of thousands of numbers
// each: they wait in files without a name, and memory does not grow with their number.

namespace ghtrack {

/// Which runs of a campaign are there.
class RunSet {
 public:
  explicit RunSet(const Campaign& campaign);

  bool has(std::size_t cell, int run) const {
    return runs_.at(cell).at(static_cast<std::size_t>(run));
  }
  void add(std::size_t cell, int run) { runs_.at(cell).at(static_cast<std::size_t>(run)) = true; }

  /// How many are not there.
  std::int64_t missing() const;

 private:
  std::vector<std::vector<bool>> runs_;  // by cell
};

/// Numbers of all runs of a cell, turned around: by their place in the layout, then by run.
class ResultColumns {
 public:
  ResultColumns(NumberFile numbers, std::size_t runs) : numbers_(std::move(numbers)), runs_(runs) {}

  /// One number of every run.
  std::vector<double> at(std::size_t place) const;

 private:
  NumberFile numbers_;
  std::size_t runs_;
};

/// Results of a campaign, by cell and run: numbers as TrialLayout says.
class Results {
 public:
  /// @param folder  where there is room for as much as the results are, and once more
  explicit Results(const Campaign& campaign,
                   std::filesystem::path folder = std::filesystem::temp_directory_path());

  const RunSet& runs() const { return runs_; }
  bool has(std::size_t cell, int run) const { return runs_.has(cell, run); }
  std::int64_t missing() const { return runs_.missing(); }

  /// @param scores  as many as the cell's layout has
  void put(std::size_t cell, int run, std::span<const double> scores);

  /// What was put there; nothing for a run that is missing.
  std::vector<double> at(std::size_t cell, int run) const;

  /// All runs of a cell, none of which may be missing. In a bounded part of memory.
  ResultColumns columns(std::size_t cell) const;

 private:
  struct CellPlace {
    std::size_t runs = 0;
    std::size_t width = 0;    // of a run
    std::uint64_t first = 0;  // of its first run, in the file
  };

  std::filesystem::path folder_;
  RunSet runs_;
  std::vector<CellPlace> cells_;
  NumberFile numbers_;  // by cell, run and place in the layout
};

}  // namespace ghtrack
