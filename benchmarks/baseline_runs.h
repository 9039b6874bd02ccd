/// One search of one planner on one problem, timed and checked, and the problems.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/planner.h"

namespace prehensile::benchmarks {

struct Problem {
  std::string kind;
  Scene scene;
};

struct Run {
  std::string kind, problem, planner;
  std::uint64_t seed = 0;
  Plan plan;
  bool solved = false;
  double us = kNan;  ///< thread CPU time of the search alone: search_time_us
};

/// The first `count` published pairs with the square and the T, in four attitudes of
/// gravity.
std::vector<Problem> published_problems(int count);

/// Wide problems with the T, `count` with gravity and as many without.
std::vector<Problem> wide_problems(int count, std::uint64_t seed);

/// Three in four of them wide Ts, the others squares; half of them with gravity.
std::vector<Problem> tuning_problems(int count, std::uint64_t seed);

/// Searches with the planner of the options and puts its pushes, as they are, to the
/// exact check and the replay.
Run run_planner(const Problem& problem, const PlanOptions& options, bool robust);

}  // namespace prehensile::benchmarks
