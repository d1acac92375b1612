#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace ghtrack {

/// Calls `work` with `jobs` threads, this one among them; with fewer where the system does not give
/// as many, and with this one alone inside of a call of work.
void on_threads(int jobs, const std::function<void()>& work);

/// What one thread would have come to first of all that several have thrown.
struct FirstFailure {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  std::size_t item = kNone;
  std::exception_ptr error;

  /// The item of this number has thrown what is being handled.
  void note(std::size_t number) {
    if (number >= item) return;
    item = number;
    error = std::current_exception();
  }
  void rethrow_if_any() const {
    if (error) std::rethrow_exception(error);
  }
};

/// Calls `task` with 0, 1, …, count − 1, in any order, with `jobs` threads. An exception ends it
/// after the tasks under way and is passed on: of several, that of the least number.
void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& task);

/// Work on items one after the other as `next` hands them out, by several threads, whose results
/// are delivered in the order of the items, one call at a time. An exception ends it all and is
/// passed on: of several, that of the first item, as if there were one thread.
template <class Item, class Result>
class OrderedWork {
 public:
  using Next = std::function<std::optional<Item>()>;
  using Work = std::function<Result(const Item&)>;
  using Deliver = std::function<void(Result)>;

  OrderedWork(Next next, Work work, Deliver deliver)
      : next_(std::move(next)), work_(std::move(work)), deliver_(std::move(deliver)) {}

  void run(int jobs) {
    most_ = 2 * static_cast<std::size_t>(jobs);
    on_threads(jobs, [this] { work_on_items(); });
    failure_.rethrow_if_any();
  }

 private:
  void work_on_items() {
    std::unique_lock lock(mutex_);
    for (;;) {
      // No more of them under way or waiting, or one slow item would fill the memory.
      changed_.wait(lock, [this] { return is_over() || given_ - delivered_ < most_; });
      if (is_over()) return;
      const std::size_t number = given_++;
      try {
        const std::optional<Item> item = next_();
        if (!item) {
          ended_ = true;
          changed_.notify_all();
          return;
        }
        lock.unlock();
        Result result = work_(*item);
        lock.lock();
        done_.emplace(number, std::move(result));
      } catch (...) {
        fail(lock, number);
        return;
      }
      deliver_done(lock);
    }
  }

  /// Delivers what is done and comes next; while one thread does, the others go on working.
  void deliver_done(std::unique_lock<std::mutex>& lock) {
    if (delivering_) return;
    delivering_ = true;
    for (auto at = done_.find(delivered_); at != done_.end() && failure_.item > delivered_;
         at = done_.find(delivered_)) {
      Result result = std::move(at->second);
      done_.erase(at);
      lock.unlock();
      try {
        deliver_(std::move(result));
        lock.lock();
      } catch (...) {
        fail(lock, delivered_);
      }
      ++delivered_;
      changed_.notify_all();
    }
    delivering_ = false;
  }

  void fail(std::unique_lock<std::mutex>& lock, std::size_t number) {
    if (!lock) lock.lock();
    failure_.note(number);
    changed_.notify_all();
  }

  bool is_over() const { return ended_ || failure_.item != FirstFailure::kNone; }

  Next next_;
  Work work_;
  Deliver deliver_;
  std::size_t most_ = 0;

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::size_t given_ = 0;
  std::size_t delivered_ = 0;
  bool ended_ = false;       // there are no more items
  bool delivering_ = false;  // by one of the threads
  std::map<std::size_t, Result> done_;
  FirstFailure failure_;
};

}  // namespace ghtrack
