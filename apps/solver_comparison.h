/// One instant by every solver that can answer it, side by side.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "mechanics/solvers.h"

namespace prehensile::apps {

struct TimedAnswer {
  InstantAnswer answer;
  std::string status;  ///< in words; why the solver was left out if it was
  double microseconds = kNan;
};

/// By all solvers of this build, left out and refused ones included.
std::vector<TimedAnswer> compare_solvers(const InstantQuestion& question,
                                         const SolverOptions& options);

/// By one solver.
TimedAnswer timed_answer(const InstantQuestion& question, const SolverOptions& options);

std::string describe(const std::vector<TimedAnswer>& answers);
nlohmann::ordered_json to_json(const std::vector<TimedAnswer>& answers);

}  // namespace prehensile::apps
