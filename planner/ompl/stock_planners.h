/// OMPL's own planners, set up for pushes.
#pragma once

#include <string>
#include <vector>

#include <ompl/base/Planner.h>

#include "planner/ompl/push_problem.h"

namespace prehensile {

std::vector<std::string> stock_planner_names();

/// The planner of this name with the problem set, ready to solve; null if unknown.
/// OMPL's defaults are in state units and suit rooms: radii and ranges are set from the
/// size of the object.
ompl::base::PlannerPtr make_stock_planner(const std::string& name,
                                          const PushProblem& problem);

/// Whether the planner improves its solution until it is stopped, where others return
/// their first.
bool improves_until_stopped(const std::string& name);

}  // namespace prehensile
