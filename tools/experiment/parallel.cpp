#include "tools/experiment/parallel.hpp"

#include <algorithm>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace ghtrack {
namespace {

thread_local bool is_at_work = false;

void work_alone(const std::function<void()>& work) {
  is_at_work = true;
  work();
  is_at_work = false;
}

}  // namespace

void on_threads(int jobs, const std::function<void()>& work) {
  if (is_at_work) return work();
  const auto wanted = static_cast<std::size_t>(jobs);
  std::promise<std::size_t> told;
  const std::shared_future<std::size_t> staff = told.get_future().share();
  std::vector<std::jthread> threads;
  try {
    while (threads.size() + 1 < wanted) {
      threads.emplace_back([&, number = threads.size()] {
        if (number < staff.get()) work_alone(work);
      });
    }
    told.set_value(threads.size());
  } catch (const std::exception&) {  // std::system_error or std::bad_alloc: no more than these
    // Where there is a limit, others may need threads and memory as well: be content with half.
    told.set_value(threads.size() / 2);
  }
  work_alone(work);
}

void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& task) {
  std::mutex mutex;  // of all below
  std::size_t next = 0;
  FirstFailure failure;
  on_threads(static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(jobs), count)), [&] {
    std::unique_lock lock(mutex);
    while (next < count && !failure.error) {
      const std::size_t number = next++;
      lock.unlock();
      try {
        task(number);
        lock.lock();
      } catch (...) {
        if (!lock) lock.lock();
        failure.note(number);
      }
    }
  });
  failure.rethrow_if_any();
}

}  // namespace ghtrack
