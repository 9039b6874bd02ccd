#include "planner/ompl/push_planner.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <ompl/base/ScopedState.h>
#include <ompl/geometric/PathGeometric.h>

#include "planner/search/push_search.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;

/// Stick tests of the first round of a search with a termination condition: about a
/// millisecond.
constexpr std::int64_t kFirstRound = 10'000;

ob::PlannerStatus status_of(PlanStatus status) {
  switch (status) {
    case PlanStatus::kReachedGoal:
    case PlanStatus::kNothingToDo:
      return ob::PlannerStatus::EXACT_SOLUTION;
    case PlanStatus::kBudgetSpent:
    case PlanStatus::kStopped:
      return ob::PlannerStatus::TIMEOUT;
    case PlanStatus::kInfeasible:
      return ob::PlannerStatus::INVALID_GOAL;
    case PlanStatus::kNotRun:
    case PlanStatus::kUnsupported:
      break;
  }
  return ob::PlannerStatus::ABORT;
}

}  // namespace

PushPlanner::PushPlanner(const PushProblem& problem, const PlanOptions& options)
    : ob::Planner(problem.space_information(), "push"),
      problem_(problem),
      options_(options) {
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  specs_.directed = true;
  specs_.multithreaded = false;
}

ob::PlannerStatus PushPlanner::solve(const ob::PlannerTerminationCondition& condition) {
  const Work& work = problem_.work();
  options_.settings["fallback_share"] = 0.0;
  for (std::int64_t round = kFirstRound; !condition(); round *= 2) {
    const std::int64_t budget = std::min(work.budget, work.done() + round);
    const ob::PlannerStatus status = search(budget);
    const bool cut_short =
        plan_.status == PlanStatus::kBudgetSpent && work.done() >= budget;
    if (!cut_short || work.spent()) return status;
  }
  return ob::PlannerStatus::TIMEOUT;
}

ob::PlannerStatus PushPlanner::solve_within_options() {
  return search(problem_.work().budget);
}

ob::PlannerStatus PushPlanner::search(std::int64_t budget) {
  checkValidity();
  const auto* goal = dynamic_cast<const PushGoal*>(pdef_->getGoal().get());
  if (goal == nullptr) return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  Work& work = problem_.work();
  const std::int64_t whole = std::exchange(work.budget, budget);
  plan_ = search_pushes(problem_.steps()->search(), start_grasp(), goal->wanted(),
                        options_, work);
  work.budget = whole;
  if (plan_.usable()) add_solution();
  return status_of(plan_.status);
}

void PushPlanner::clear() {
  ob::Planner::clear();
  plan_ = Plan{};
}

Grasp PushPlanner::start_grasp() const {
  const ob::State* state = pdef_->getStartState(0);
  ob::ScopedState<> given(si_);
  problem_.space().write(state_of(problem_.start()), given.get());
  if (si_->equalStates(state, given.get())) return problem_.start();
  return grasp_of(problem_.space().read(state));
}

void PushPlanner::add_solution() {
  const auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
  ob::ScopedState<> state(si_);
  const auto append = [&](const Grasp& grasp) {
    problem_.space().write(state_of(grasp), state.get());
    path->append(state.get());
  };
  append(start_grasp());
  for (const PlannedPush& push : plan_.pushes) append(push.end);
  pdef_->addSolutionPath(path, false, 0.0, getName());
}

}  // namespace prehensile
