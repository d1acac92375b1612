#include "tools/experiment/results.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "tools/experiment/trial.hpp"

namespace ghtrack {
namespace {

constexpr std::size_t kMostTurned = std::size_t{1} << 20;  // numbers in memory at a time

}  // namespace

RunSet::RunSet(const Campaign& campaign) {
  for (const CampaignCell& cell : campaign.cells) {
    runs_.emplace_back(static_cast<std::size_t>(cell.runs()), false);
  }
}

std::int64_t RunSet::missing() const {
  std::int64_t missing = 0;
  for (const std::vector<bool>& runs : runs_) {
    missing += std::count(runs.begin(), runs.end(), false);
  }
  return missing;
}

std::vector<double> ResultColumns::at(std::size_t place) const {
  std::vector<double> column(runs_);
  numbers_.read(static_cast<std::uint64_t>(place) * runs_, column);
  return column;
}

Results::Results(const Campaign& campaign, std::filesystem::path folder)
    : folder_(std::move(folder)), runs_(campaign), numbers_(folder_.string()) {
  std::uint64_t first = 0;
  for (const CampaignCell& cell : campaign.cells) {
    const CellPlace place{.runs = static_cast<std::size_t>(cell.runs()),
                          .width = layout_of(cell.scene).size(),
                          .first = first};
    first += std::uint64_t{place.runs} * place.width;
    cells_.push_back(place);
  }
}

void Results::put(std::size_t cell, int run, std::span<const double> scores) {
  const CellPlace& place = cells_.at(cell);
  if (scores.size() != place.width) throw std::invalid_argument("not the scores of a run");
  numbers_.write(place.first + static_cast<std::uint64_t>(run) * place.width, scores);
  runs_.add(cell, run);
}

std::vector<double> Results::at(std::size_t cell, int run) const {
  if (!has(cell, run)) return {};
  const CellPlace& place = cells_[cell];
  std::vector<double> scores(place.width);
  numbers_.read(place.first + static_cast<std::uint64_t>(run) * place.width, scores);
  return scores;
}

ResultColumns Results::columns(std::size_t cell) const {
  const CellPlace& place = cells_.at(cell);
  const std::size_t most = std::max<std::size_t>(1, kMostTurned / place.width);  // runs at a time
  NumberFile turned(folder_.string());
  std::vector<double> rows, columns;
  for (std::size_t run = 0; run < place.runs; run += most) {
    const std::size_t runs = std::min(most, place.runs - run);
    rows.resize(runs * place.width);
    columns.resize(runs * place.width);
    numbers_.read(place.first + std::uint64_t{run} * place.width, rows);
    for (std::size_t i = 0; i < runs; ++i) {
      for (std::size_t k = 0; k < place.width; ++k) {
        columns[k * runs + i] = rows[i * place.width + k];
      }
    }
    for (std::size_t k = 0; k < place.width; ++k) {
      turned.write(std::uint64_t{k} * place.runs + run,
                   std::span<const double>(columns).subspan(k * runs, runs));
    }
  }
  return {std::move(turned), place.runs};
}

}  // namespace ghtrack
