/// OMPL's own planners, set up for pushes.
#pragma once

#include <ompl/base/Planner.h>

#include "planner/catalogue.h"
#include "planner/ompl/push_problem.h"

namespace prehensile {

/// The planner of the catalogue with the problem and the options set, ready to solve;
/// null where this algorithm is not known. OMPL's own defaults are in state units and
/// suit rooms; those of the catalogue are tuned for pushes. The problem must have been
/// made with `meaning_for` of the family.
ompl::base::PlannerPtr make_stock_planner(const PlannerKind& kind,
                                          const PlannerSettings& settings,
                                          const PushProblem& problem);

ControlMeaning meaning_for(PlannerFamily family);

/// The bare planner, without options: of one family each.
ompl::base::PlannerPtr make_geometric(const std::string& algorithm,
                                      const PushProblem& problem);
ompl::base::PlannerPtr make_control(const std::string& algorithm,
                                    const PushProblem& problem, int cells);

}  // namespace prehensile
