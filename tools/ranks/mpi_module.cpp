// The only file that knows MPI.

#include <mpi.h>

#include "tools/ranks/ranks.hpp"

namespace {

class MpiRanks final : public ghtrack::Ranks {
 public:
  MpiRanks() {
    // Only the main thread speaks to MPI.
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &index_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int index() const override { return index_; }
  int count() const override { return count_; }
  void wait_for_all() override { MPI_Barrier(MPI_COMM_WORLD); }

 private:
  int index_ = 0;
  int count_ = 1;
};

}  // namespace

extern "C" ghtrack::Ranks* ghtrack_mpi_ranks() {
  static MpiRanks ranks;
  return &ranks;
}
