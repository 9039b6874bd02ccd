#include "apps/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace prehensile::apps {

int number_of_jobs(int asked) {
  if (asked > 0) return asked;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void for_each_index(int count, int jobs, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  std::mutex mutex;
  int failed = count;
  std::exception_ptr failure;
  const auto run = [&] {
    for (int i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        // Indices are handed out in order: whatever comes before this one has begun, and
        // its thread reports by itself if it fails.
        const std::lock_guard lock(mutex);
        if (i < failed) {
          failed = i;
          failure = std::current_exception();
        }
        return;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    const int helpers = std::min(jobs, count) - 1;
    threads.reserve(static_cast<std::size_t>(std::max(0, helpers)));
    for (int k = 0; k < helpers; ++k) threads.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace prehensile::apps
