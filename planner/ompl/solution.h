/// From OMPL's solution paths to pushes.
#pragma once

#include <optional>
#include <vector>

#include <ompl/base/Path.h>

#include "planner/ompl/push_problem.h"

namespace prehensile {

/// The pushes along a path of the problem, control or geometric: every segment is steered
/// again from its two states, so nothing is taken from the planner on trust, and
/// consecutive moves that are one straight move are joined. Nothing if a segment is no
/// push or the end is not in the goal. Counts no work.
std::optional<std::vector<PlannedPush>> pushes_along(const PushProblem& problem,
                                                     ompl::base::Path& path);

}  // namespace prehensile
