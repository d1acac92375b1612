#include "tools/ranks/ranks.hpp"

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "tools/modules/module.hpp"

namespace ghtrack {
namespace {

class OneRank final : public Ranks {
 public:
  int index() const override { return 0; }
  int count() const override { return 1; }
  void wait_for_all(const std::function<void()>& /*meanwhile*/) override {}
  void leave() override {}
};

/// Open MPI's mpirun and Slurm's srun (with PMIx or PMI-2) announce themselves in this way.
bool started_by_launcher() {
  constexpr std::array kSigns = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
  for (const char* const sign : kSigns) {
    if (std::getenv(sign) != nullptr) return true;
  }
  return false;
}

Ranks& make_ranks() {
  static OneRank alone;
  if (!started_by_launcher()) return alone;
  if (!has_module(kRanksModule)) {
    throw std::runtime_error(
        "started by an MPI launcher, but built without MPI: install libopenmpi-dev and build "
        "again, or split the work with --shard I/N and --merge");
  }
  const auto factory = reinterpret_cast<RanksFactory>(module_symbol(kRanksModule, kRanksFactory));
  return *factory();
}

}  // namespace

Ranks& join_ranks() {
  static Ranks& ranks = make_ranks();
  return ranks;
}

}  // namespace ghtrack
