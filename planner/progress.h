/// How far a search is, for people who wait. Tells, and decides nothing.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>

namespace prehensile {

/// What a search has reached so far.
struct SearchProgress {
  std::string_view stage;  ///< "search", "search without margin", "polish", "check", ...
  double best_cost = std::numeric_limits<double>::quiet_NaN();  ///< J; NaN: none found
  double lower_bound = std::numeric_limits<double>::quiet_NaN();
  std::int64_t tests = 0;  ///< stick tests and propagations
  double seconds = 0.0;    ///< since planning began
  double tests_per_second() const {
    return seconds > 0.0 ? static_cast<double>(tests) / seconds : 0.0;
  }
  double gap() const { return (best_cost - lower_bound) / lower_bound; }
};

/// Called from within the planner, on its thread, at most every kProgressInterval.
using ProgressCallback = std::function<void(const SearchProgress&)>;
inline constexpr double kProgressInterval = 0.1;  // [s]

/// Collects what a search reports and passes it on now and then.
class ProgressMeter {
 public:
  explicit ProgressMeter(const ProgressCallback& callback)
      : callback_(callback), begin_(Clock::now()), last_(begin_) {}

  void enter(std::string_view stage) { progress_.stage = stage; }
  void bound(double lower_bound) { progress_.lower_bound = lower_bound; }

  /// The best plan is the last one found: one with a margin may cost more than one
  /// without, and a search starts anew for each.
  void forget_best() { progress_.best_cost = std::numeric_limits<double>::quiet_NaN(); }
  void found(double cost) {
    if (!(cost >= progress_.best_cost)) progress_.best_cost = cost;
  }

  /// Called often: looks at the clock every 64th time only.
  void tick(std::int64_t tests) {
    if (++ticks_ % 64 != 0) return;
    const Clock::time_point now = Clock::now();
    if (std::chrono::duration<double>(now - last_).count() < kProgressInterval) return;
    last_ = now;
    progress_.tests = tests;
    progress_.seconds = std::chrono::duration<double>(now - begin_).count();
    callback_(progress_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  const ProgressCallback& callback_;
  Clock::time_point begin_, last_;
  SearchProgress progress_;
  std::int64_t ticks_ = 0;
};

}  // namespace prehensile
