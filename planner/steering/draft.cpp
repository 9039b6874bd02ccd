#include "planner/steering/draft.h"

#include "planner/steering/goal.h"
#include "planner/steering/roll_step.h"

namespace prehensile {
namespace {

void say_undecided(const Limits& limits, Plan& plan) {
  plan.status = limits.stopped() ? PlanStatus::kStopped : PlanStatus::kBudgetSpent;
  plan.message =
      limits.stopped()       ? "stopped before a plan was found"
      : limits.out_of_time() ? "no plan found within the time limit"
      : limits.reached()     ? "no plan found within the work budget"
      : plan.margin.is_none()
          ? "every stage of the search ended without a plan"
          : "every stage of the search ended without a plan within the margin; a "
            "smaller margin may admit one";
}

}  // namespace

Plan blank_plan(const SearchModel& search, const Grasp& start,
                const PlanOptions& options) {
  Plan plan;
  plan.start = start;
  plan.goal = start;
  plan.margin = search.margin;
  plan.planner = options.planner;
  plan.seed = options.seed;
  return plan;
}

void append_move(const SearchModel& search, const Move& move, Plan& plan) {
  const double psi = plan.pushes.empty() ? plan.start.psi : plan.pushes.back().end.psi;
  plan.pushes.push_back(
      {push_of(search, move), grasp_of(move.from, psi), grasp_of(move.to, psi)});
  plan.goal = plan.pushes.back().end;
}

void append_chain(const SearchModel& search, const FlatState& start, const Chain& chain,
                  Plan& plan) {
  for (const Move& move : moves_of(search, start, chain)) append_move(search, move, plan);
}

void say_no_roll(const char* where, Plan& plan) {
  plan.status = PlanStatus::kBudgetSpent;
  plan.message = std::string("no contact rolls the object ") + where;
  plan.pushes.clear();
}

void conclude_search(const SearchModel& search, const Goal& goal,
                     const PlanOptions& options, bool found, const Limits& limits,
                     Plan& plan) {
  if (!found) return say_undecided(limits, plan);
  const double dpsi = roll_needed(goal, plan.start.psi);
  if (dpsi != 0.0 &&
      !insert_roll(*search.model, dpsi, search.margin, options.transition, plan)) {
    return say_no_roll("at any pose of the plan", plan);
  }
  plan.status = PlanStatus::kReachedGoal;
}

}  // namespace prehensile
