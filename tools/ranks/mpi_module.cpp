// The only file that knows MPI.

#include <mpi.h>

#include <chrono>
#include <thread>

#include "tools/ranks/ranks.hpp"

namespace {

constexpr auto kPause = std::chrono::milliseconds(1);

class MpiRanks final : public ghtrack::Ranks {
 public:
  MpiRanks() {
    // Only the main thread speaks to MPI.
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &index_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }

  int index() const override { return index_; }
  int count() const override { return count_; }
  // MPI_Barrier would keep a processor busy, and could not be given up.
  void wait_for_all(const std::function<void()>& meanwhile) override {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    for (int done = 0;;) {
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done != 0) return;
      meanwhile();
      std::this_thread::sleep_for(kPause);
    }
  }
  void leave() override { MPI_Finalize(); }

 private:
  int index_ = 0;
  int count_ = 1;
};

}  // namespace

extern "C" ghtrack::Ranks* ghtrack_mpi_ranks() {
  static MpiRanks ranks;
  return &ranks;
}
