#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tools/experiment/campaign.hpp"
#include "tools/experiment/results.hpp"
#include "tools/experiment/shared_truth.hpp"

namespace ghtrack {

/// The part of a campaign that one process computes. The runs of all groups of cells that share a
/// truth are numbered one after the other; a share has those whose number leaves the remainder
/// `index` when divided by `count`. So no truth is simulated by two processes.
struct Shard {
  int index = 0;  // from 0
  int count = 1;
};

/// How many runs of a share are still missing.
std::int64_t runs_to_do(const Campaign& campaign, std::span<const CellGroup> groups,
                        const Shard& shard, const RunSet& done);

/// Computes the missing runs of a share with `jobs` threads.
/// @param groups     the campaign's cells by their truth
/// @param on_step    called again and again by all threads; may throw to give up
/// @param jobs       threads; fewer if the system does not allow so many
/// @param on_result  gets the scores of each run, one call at a time, in the order of groups, runs
///                   and cells; an exception ends the computation and is passed on
/// @throws std::runtime_error naming the scene and the run in which something went wrong
void compute(const Campaign& campaign, std::span<const CellGroup> groups, const Shard& shard,
             const RunSet& done, int jobs, const std::function<void()>& on_step,
             const std::function<void(std::size_t cell, int run, std::vector<double>)>& on_result);

}  // namespace ghtrack
