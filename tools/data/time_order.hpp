#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace ghtrack {

/// What is to be done with a row of a series whose rows should be in the order of time.
enum class Placing {
  kKeep,    // it is in order, or out of order only because the file is
  kLate,    // false: before the rows that came before it
  kBelied,  // false: after most of the rows that follow
};

/// Tells rows that are out of order from rows whose clock was wrong.
///
/// The longest run of rows in order is trusted. Where more than three tenths of the rows are not in
/// it, the file is in another order, and every row is kept. Otherwise a row is kept if its time
/// falls between those of the trusted rows, or not further outside than a few steps, and repeats
/// none of them.
/// @param times  in the order of the file [s]
std::vector<Placing> placings(const std::vector<double>& times);

}  // namespace ghtrack
