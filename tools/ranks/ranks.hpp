#pragma once

#include <functional>

namespace ghtrack {

/// This process among those that `mpirun` or `srun` has started together.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int index() const = 0;  // from 0
  virtual int count() const = 0;
  /// Returns when all of them have called it.
  /// @param meanwhile  called again and again until then; may throw to give up
  virtual void wait_for_all(const std::function<void()>& meanwhile) = 0;
  /// The last call of a process that did its part. The launcher takes one that ends without it for
  /// failed, and stops the others instead of letting them wait for ever.
  virtual void leave() = 0;
};

/// The ranks that this process belongs to, or itself alone when no MPI launcher has started it.
/// Open MPI lies in a module that is loaded only under a launcher.
/// @throws std::runtime_error if a launcher did, and this build lacks MPI
Ranks& join_ranks();

/// Name and type of the module's only symbol.
inline constexpr const char* kRanksModule = "ghtrack_mpi";
inline constexpr const char* kRanksFactory = "ghtrack_mpi_ranks";
using RanksFactory = Ranks* (*)();  // the one instance

}  // namespace ghtrack
