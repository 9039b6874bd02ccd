/// Our own search as one of OMPL's planners.
#pragma once

#include <ompl/base/Planner.h>

#include "planner/ompl/push_problem.h"

namespace prehensile {

/// Exact steering, way-points and lattice (planner/search/push_search.h) behind the
/// interface of ompl::base::Planner. Its solution is a geometric path whose every segment
/// is one push; `plan` has the pushes themselves. `solve` draws no random numbers, so
/// OMPL's seed does not matter to it, and it never reports approximate solutions.
class PushPlanner : public ompl::base::Planner {
 public:
  /// `problem` must outlive the planner. `options` say budget, stop flag and time limit;
  /// the termination condition given to `solve` ends the search as well.
  PushPlanner(const PushProblem& problem, const PlanOptions& options);

  using ompl::base::Planner::solve;

  /// Plans from the first start state to the goal of the problem definition, which must
  /// be a PushGoal. The search cannot poll a condition, so it runs in rounds of growing
  /// budgets with the condition asked between them: it may take twice as long as allowed,
  /// and the plan is that of the first round that finds one. Without the fallback.
  ompl::base::PlannerStatus solve(
      const ompl::base::PlannerTerminationCondition& condition) override;

  /// The same in one round, ended by the options alone.
  ompl::base::PlannerStatus solve_within_options();

  void clear() override;

  /// The last plan: pushes, status, proof, bound. Not yet checked with the exact
  /// mechanics.
  const Plan& plan() const { return plan_; }

 private:
  ompl::base::PlannerStatus search(std::int64_t budget);
  Grasp start_grasp() const;
  void add_solution();

  const PushProblem& problem_;
  PlanOptions options_;
  Plan plan_;
};

}  // namespace prehensile
