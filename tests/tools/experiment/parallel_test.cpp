#include "tools/experiment/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/effort.hpp"

namespace ghtrack {
namespace {

// Property: every task is done once, whatever the number of threads, and inside of one another.
TEST(InParallel, DoesEveryTaskOnce) {
  for (const int jobs : {1, 2, 3, 16}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
      std::vector<std::atomic<int>> done(count);
      in_parallel(count, jobs,
                  [&](std::size_t i) { in_parallel(3, jobs, [&](std::size_t) { ++done[i]; }); });
      for (const auto& times : done) EXPECT_EQ(times, 3);
    }
  }
}

/// Squares of 0 … count − 1, of which some fail, with threads; and what came of it.
std::string squares(int count, int jobs, int fails_from, int delivery_fails = 9999) {
  int next = 0;
  std::string text;
  OrderedWork<int, int> work([&] { return next < count ? std::optional(next++) : std::nullopt; },
                             [&](const int& item) {
                               if (item % 7 == 3) std::this_thread::yield();
                               if (item >= fails_from)
                                 throw std::runtime_error("item " + std::to_string(item));
                               return item * item;
                             },
                             [&](int square) {
                               if (square == delivery_fails * delivery_fails)
                                 throw std::runtime_error("delivery");
                               text += std::to_string(square) + " ";
                             });
  try {
    work.run(jobs);
  } catch (const std::runtime_error& error) {
    text += error.what();
  }
  return text;
}

// Property: with any number of threads, results come in the order of their items, and what is
// thrown is what one thread would have come to first, after the same results.
TEST(OrderedWork, IsAsIfThereWereOneThread) {
  EXPECT_EQ(squares(5, 1, 9), "0 1 4 9 16 ");
  EXPECT_EQ(squares(5, 1, 3), "0 1 4 item 3");
  EXPECT_EQ(squares(5, 1, 4, 2), "0 1 delivery");
  for (const int jobs : {2, 3, 8}) {
    for (int repeat = 0; repeat < testing::samples(50); ++repeat) {
      EXPECT_EQ(squares(200, jobs, 999), squares(200, 1, 999));
      EXPECT_EQ(squares(200, jobs, 150), squares(200, 1, 150));
      EXPECT_EQ(squares(200, jobs, 120, 50), squares(200, 1, 120, 50));
    }
  }
}

// Property: no more items are under way or waiting than the threads can use, so that one slow item
// does not gather the results of all that follow it.
TEST(OrderedWork, KeepsFewResults) {
  constexpr int kJobs = 4;
  std::atomic<int> waiting = 0;
  int next = 0;
  int most = 0;
  OrderedWork<int, int>([&] { return next < 500 ? std::optional(next++) : std::nullopt; },
                        [&](const int& item) {
                          ++waiting;
                          if (item % 50 == 0)
                            std::this_thread::sleep_for(std::chrono::milliseconds(2));
                          return item;
                        },
                        [&](int) { most = std::max(most, waiting--); })
      .run(kJobs);
  EXPECT_LE(most, 2 * kJobs);
}

}  // namespace
}  // namespace ghtrack
