#pragma once

#include <vector>

#include "sim/encounter/heap.hpp"

namespace ghtrack::encounter {

/// A step of the heap, and where everyone is within it: those in the heap on cubics, which saves
/// to solve for their forces again and again, the others as they move alone.
struct Trial {
  const Instant& start;
  const Heap& heap;
  Instant end;     // of the heap alone
  Heap heap_then;  // with the pushes there
};

/// @param start,heap  must outlive the trial
Trial try_step(const Crowd& crowd, const Instant& start, const Heap& heap, double time);

/// @param only  a pair whose motion alone is wanted
/// @param log   of impacts on surfaces on the way
Instant within(const Crowd& crowd, const Trial& trial, double time, const Pair* only = nullptr,
               ImpactLog* log = nullptr);

/// Everyone at the end of a step: those in the heap together, the others alone.
/// @param logs  of impacts on surfaces on the way, by body
Instant finished(const Crowd& crowd, Trial trial, std::vector<ImpactLog>& logs);

}  // namespace ghtrack::encounter
