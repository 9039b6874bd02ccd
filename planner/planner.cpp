#include "planner/planner.h"

#include <algorithm>
#include <chrono>

#include "planner/bounds.h"
#include "planner/exact_check.h"
#include "planner/frame.h"
#include "planner/polish.h"
#include "planner/push_search.h"
#include "planner/refuse.h"

namespace prehensile {
namespace {

constexpr const char* kOwnPlanner = "push";

Plan search_plan(const SearchModel& search, const PlanOptions& options, Work& work) {
  const Scene& scene = search.model->scene;
  if (frame_is_built()) {
    return solve_in_frame(search, scene.start, *scene.goal, options, work);
  }
  return search_pushes(search, scene.start, *scene.goal, options, work);
}

void set_undecided(Plan& plan, std::string message) {
  plan.status = PlanStatus::kBudgetSpent;
  plan.message = std::move(message);
  plan.pushes.clear();
}

/// Polishes a plan found and puts it to the exact check, the plan as found if the shorter
/// one fails; undecided with the reason if both fail.
void finish(const SearchModel& search, const PlanOptions& options, const Limits& limits,
            Work& work, Plan& plan) {
  const Model& model = *search.model;
  std::string why;
  if (options.polish) {
    Plan shorter = plan;
    polish(search, limits, work, shorter);
    if (check_exactly(model, options.transition, shorter, &why)) {
      plan = std::move(shorter);
      return;
    }
    plan.instants = shorter.instants;
  }
  if (check_exactly(model, options.transition, plan, &why)) return;
  set_undecided(plan, "the plan found fails its exact check: " + why);
}

/// One search for one margin, finished and checked.
Plan attempt(const Model& model, const PlanOptions& options, double scale, Work& work) {
  const SearchModel search = prepare_search(model, options.margin.scaled(scale));
  if (search.contacts.empty()) {
    Plan plan = blank_plan(search, model.scene.start, options);
    plan.status = PlanStatus::kUnsupported;
    plan.message =
        "nothing can be pushed: the pads have no friction, no grip or no torque";
    return plan;
  }
  const Limits limits(options, work);
  Plan plan = search_plan(search, options, work);
  if (plan.status == PlanStatus::kReachedGoal) {
    finish(search, options, limits, work, plan);
    if (plan.usable() && !reaches(*model.scene.goal, plan.goal)) {
      set_undecided(plan, "the plan found ends beside the goal");
    }
  }
  return plan;
}

/// A plan that fails its exact check is searched again with double the margin.
Plan search_and_check(const Model& model, const PlanOptions& options, Work& work) {
  Plan plan = attempt(model, options, 1.0, work);
  const bool failed_check = plan.instants > 0 && !plan.usable();
  if (failed_check) {
    Plan again = attempt(model, options, 2.0, work);
    again.instants += plan.instants;
    if (again.usable()) return again;
    plan.instants = again.instants;
    plan.message += "; with double the margin: " + again.message;
  }
  return plan;
}

Plan decide(const Model& model, const PlanOptions& options) {
  Plan plan;
  plan.start = model.scene.start;
  plan.goal = model.scene.start;
  plan.margin = options.margin;
  plan.planner = options.planner;
  plan.seed = options.seed;
  const std::vector<std::string> names = planner_names();
  if (std::find(names.begin(), names.end(), options.planner) == names.end()) {
    plan.status = PlanStatus::kUnsupported;
    plan.message = "there is no planner " + options.planner + " in this build";
    return plan;
  }
  if (!model.scene.goal) {
    plan.status = PlanStatus::kUnsupported;
    plan.message = "the scene states no goal";
    return plan;
  }
  if (reaches(*model.scene.goal, plan.start)) {
    plan.status = PlanStatus::kNothingToDo;
    return plan;
  }
  plan.proof = find_proof(model);
  if (plan.proof.kind != Proof::Kind::kNone) {
    plan.status = PlanStatus::kInfeasible;
    plan.message = plan.proof.text;
    return plan;
  }
  Work work{.budget = options.budget};
  plan = search_and_check(model, options, work);
  plan.stick_tests = work.stick_tests;
  plan.propagations = work.propagations;
  return plan;
}

}  // namespace

std::vector<std::string> planner_names() {
  std::vector<std::string> names = {kOwnPlanner};
  for (const std::string& name : frame_planners()) {
    if (name != kOwnPlanner) names.push_back(name);
  }
  return names;
}

Plan plan_regrasp(const Model& model, const PlanOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Plan plan = decide(model, options);
  if (plan.usable()) account(model, plan);
  const bool bounded = plan.usable() || plan.status == PlanStatus::kBudgetSpent ||
                       plan.status == PlanStatus::kStopped;
  if (bounded) {
    plan.lower_bound = lower_bound(model, model.scene.start, *model.scene.goal);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  plan.seconds = spent.count();
  return plan;
}

}  // namespace prehensile
