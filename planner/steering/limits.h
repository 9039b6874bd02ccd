/// What ends a search: the work budget, a time limit if one was asked for, a stop flag.
/// Internal to the planner.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "planner/planner.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// Lets `act` spend so much work from here on at most, and gives its answer.
template <typename Act>
auto within_budget(Work& work, std::int64_t budget, Act act) {
  const std::int64_t whole = work.budget;
  work.budget = work.done() + budget;
  auto answer = act();
  work.budget = whole;
  return answer;
}

inline std::int64_t share_of_left(const Work& work, double share) {
  return static_cast<std::int64_t>(share *
                                   static_cast<double>(work.budget - work.done()));
}

/// The options with what is left of their time limit; nothing if none is. Without a limit
/// the clock decides nothing.
inline std::optional<PlanOptions> with_time_left(
    const PlanOptions& options, std::chrono::steady_clock::time_point begin) {
  PlanOptions rest = options;
  if (options.time_limit <= 0.0) return rest;
  rest.time_limit -=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (rest.time_limit <= 0.0) return std::nullopt;
  return rest;
}

class Limits {
 public:
  Limits(const PlanOptions& options, const Work& work)
      : options_(options), work_(work), begin_(std::chrono::steady_clock::now()) {}

  /// Whether to search on after the first plan.
  bool improves() const { return options_.improve; }

  bool stopped() const { return options_.stop && options_.stop->load(); }

  /// The clock is read only if there is a time limit: it decides nothing otherwise.
  bool out_of_time() const {
    if (options_.time_limit <= 0.0) return false;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
    return spent.count() > options_.time_limit;
  }

  bool reached() const {
    if (work_.meter) work_.meter->tick(work_.done());
    return work_.spent() || stopped() || out_of_time();
  }

 private:
  const PlanOptions& options_;
  const Work& work_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace prehensile
