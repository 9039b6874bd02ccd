#include "planner/planner.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "planner/bounds/bounds.h"
#include "planner/catalogue.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/holding_check.h"
#include "planner/checks/meet_end.h"
#include "planner/checks/replay.h"
#include "planner/costs.h"
#include "planner/pads/spread_pads.h"
#include "planner/proofs/refuse.h"
#include "planner/search/checked_search.h"
#include "planner/steering/confines.h"
#include "primitives/uncertainty.h"

namespace prehensile {
namespace {

/// Of a time limit, for plans with a margin and for a barrier; the rest is for plans
/// without, and what they leave for those with a part of it.
constexpr double kShareOfTime = 0.7;
constexpr double kShareOfProof = 0.15;

/// Of the work budget, for plans that survive the usual margin, and the least it is:
/// where none is found by then a nominal plan need not wait.
constexpr double kShareOfWork = 0.25;
constexpr std::int64_t kLeastWork = 5'000'000;

/// Work until a nominal plan is looked for. A box that the user states, and the search
/// for cheaper plans, have the whole budget.
std::int64_t work_with_margin(const PlanOptions& options) {
  if (options.promise != Promise::kMargin || options.improve) return options.budget;
  const auto share =
      static_cast<std::int64_t>(kShareOfWork * static_cast<double>(options.budget));
  return std::min(options.budget, std::max(share, kLeastWork));
}

/// After an interruption: the plan that was found last, if it holds without a margin.
void keep_as_nominal(const Model& model, const PlanOptions& options, const Found& found,
                     Plan& plan) {
  Plan nominal = found.plan;
  nominal.margin = Margin::none();
  meet_ends(model, options.transition, nominal);
  if (nominal.pushes.empty() ||
      !check_exactly(model, options.transition, nominal, nullptr) ||
      !reaches(*model.scene.goal, nominal.goal)) {
    return;
  }
  nominal.instants += plan.instants;
  nominal.promise = Promise::kNominalOnly;
  plan = std::move(nominal);
}

void set_infeasible(Plan& plan, const Proof& proof) {
  plan.status = PlanStatus::kInfeasible;
  plan.proof = proof;
  plan.message = proof.text;
  plan.pushes.clear();
}

/// Greater for more of the same box.
double size_of(const Margin& margin) {
  return margin.friction + margin.force + margin.torque_radius + margin.place +
         margin.centre_of_mass + margin.grasp + margin.tilt;
}

/// Why a plan has less than the margin asked for, and what it has.
std::string lesser_promise(const std::string& why, const std::string& what) {
  return "no plan was found that survives the margin (" + why + "); this one " + what;
}

/// What a plan with a margin does not promise.
std::string caveat_of(const Model& model, const Plan& plan) {
  std::string caveat = given_caveat(model, plan);
  Goal half = *model.scene.goal;
  half.position_tolerance *= 0.5;
  half.angle_tolerance *= 0.5;
  if (plan.margin.has_box() && !reaches(half, plan.goal)) {
    if (!caveat.empty()) caveat += "; ";
    caveat +=
        "it ends beside the goal, within its tolerances: within the margin its pushes "
        "stick, but part of it may end beyond them (check --samples, --success goal)";
  }
  return caveat;
}

/// Of a margin that no plan was found for, a half, then a quarter more or less: a plan
/// that survives so much is better than the nominal one, which is given back where no
/// such plan is found. `why` there is none for the whole.
Plan with_part_of_margin(const Model& model, const PlanOptions& options,
                         std::chrono::steady_clock::time_point begin,
                         const Margin& margin, const std::string& why, Work& work,
                         Plan nominal) {
  constexpr int kTries = 2;
  Plan best = std::move(nominal);
  double share = 0.5;
  for (int i = 0; i < kTries && size_of(margin) > 0.0; ++i) {
    const auto rest = with_time_left(options, begin);
    if (!rest || Limits(options, work).stopped()) break;
    work.budget = work.done() + work_with_margin(options);
    Found found;
    Plan plan = search_and_check(model, *rest, margin.scaled(share), work, found,
                                 Asked::kPartOfMargin);
    const std::int64_t instants = best.instants + plan.instants;
    const bool survives = plan.usable();
    if (survives) {
      plan.promise = Promise::kPartOfMargin;
      plan.message = lesser_promise(
          why, "survives " + std::to_string(std::lround(100.0 * share)) + " % of it");
      const std::string caveat = caveat_of(model, plan);
      if (!caveat.empty()) plan.message += "; " + caveat;
      best = std::move(plan);
    }
    best.instants = instants;
    share += survives ? 0.25 : -0.25;
  }
  return best;
}

/// With the margin; if that finds nothing, a barrier is looked for, and if there is none
/// either, a plan without margin, and then one for a part of it; where a barrier takes
/// longer than that, the plan first.
Plan search_with_and_without(const Model& model, const PlanOptions& options, Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  const Margin margin = options.margin.value_or(usual_margin(model));
  const bool nominal = margin.is_none();
  const bool falls_back = options.nominal_if_needed && !nominal;
  PlanOptions robust = options;
  robust.time_limit *= falls_back      ? kShareOfTime
                       : options.prove ? 1.0 - kShareOfProof
                                       : 1.0;
  if (falls_back) {
    work.budget = work.done() + work_with_margin(options);
  }
  Found found;
  Plan plan = search_and_check(model, robust, margin, work, found);
  plan.promise = nominal ? Promise::kNominal : options.promise;
  const bool undecided =
      plan.status == PlanStatus::kBudgetSpent || plan.status == PlanStatus::kStopped;
  if (!undecided) {
    const std::string caveat = plan.usable() ? caveat_of(model, plan) : std::string();
    if (!caveat.empty() && !plan.message.empty()) plan.message += "; ";
    plan.message += caveat;
    return plan;
  }
  if (Limits(options, work).stopped()) {
    if (falls_back) keep_as_nominal(model, options, found, plan);
    return plan;
  }
  PlanOptions of_proof = options;
  of_proof.time_limit *= kShareOfProof;
  const bool proves_last = falls_back && has_clipped_discs(model);
  const auto is_refuted = [&] {
    const Proof proof = look_for_barrier(model, of_proof, work);
    if (proof.kind != Proof::Kind::kNone) set_infeasible(plan, proof);
    return proof.kind != Proof::Kind::kNone;
  };
  if ((!proves_last && is_refuted()) || !falls_back) return plan;
  PlanOptions rest = options;
  rest.time_limit *= 1.0 - kShareOfTime - kShareOfProof;
  work.budget = work.done() + options.budget;
  Plan without = search_and_check(model, rest, Margin::none(), work, found);
  without.instants += plan.instants;
  if (!without.usable()) {
    plan.instants = without.instants;
    plan.message = "with a margin and without: " + without.message;
    if (proves_last && !Limits(options, work).stopped()) is_refuted();
    return plan;
  }
  without.promise = Promise::kNominalOnly;
  without.message = lesser_promise(
      plan.message, "is nominal: it holds for the values of the scene only");
  return with_part_of_margin(model, options, begin, margin, plan.message, work,
                             std::move(without));
}

/// Planners that carry on where ours has ended and leaves a gap, the quickest first, and
/// the work that each may do: propagations, each with many queries of collisions among
/// obstacles.
constexpr std::array kOthers = {"two-trees", "random-shooting", "geometric::RRTstar"};
constexpr std::int64_t kWorkOfOthers = 200'000;
constexpr std::int64_t kWorkAmongObstacles = 4'000'000;

/// Of the time that is left, for ours.
constexpr double kShareOfOwn = 0.5;

/// Whichever survives more or, surviving the same, is cheaper.
void keep_better(const Model& model, Plan other, Plan& plan) {
  if (!other.usable()) return;
  account(model, other);
  account(model, plan);
  const double more = size_of(other.margin) - size_of(plan.margin);
  if (more > 0.0 || (more == 0.0 && other.cost < plan.cost)) plan = std::move(other);
}

/// Whether it survives what was asked for.
bool is_whole(const Plan& plan) {
  return plan.promise != Promise::kNominalOnly && plan.promise != Promise::kPartOfMargin;
}

bool leaves_gap(const Model& model, const Plan& plan) {
  const Goal goal = goal_within_limits(model.scene);
  const BoundOptions of_plan{.margin = plan.margin};
  return plan.cost >
         kGapAsked *
             lower_bound(model, model.scene.start, goal, plan.cost, of_plan).value;
}

/// The others by turns, each with a share of the work and the time.
void search_by_others(const Model& model, const PlanOptions& options,
                      std::chrono::steady_clock::time_point begin, Work& work,
                      Plan& plan) {
  const std::int64_t whole = work.budget;
  const std::int64_t most = model.scene.obstacles ? kWorkAmongObstacles : kWorkOfOthers;
  for (std::size_t i = 0; i < kOthers.size(); ++i) {
    auto rest = with_time_left(options, begin);
    work.budget = whole;
    if (!rest || Limits(*rest, work).reached() || !leaves_gap(model, plan)) break;
    rest->planner = kOthers[i];
    rest->settings = {};
    if (!planner_fault(rest->planner, {}).empty()) continue;
    const auto left = static_cast<double>(kOthers.size() - i);
    rest->time_limit /= left;
    work.budget = work.done() + std::min(most, share_of_left(work, 1.0 / left));
    Found found;
    Plan other = search_and_check(model, *rest, plan.margin, work, found);
    if (!other.usable()) continue;
    other.promise = plan.promise;
    other.message = is_whole(plan) ? caveat_of(model, other) : plan.message;
    account(model, other);
    if (other.cost < plan.cost) keep_better(model, std::move(other), plan);
  }
  work.budget = whole;
}

/// With `improve`: what is found without it, what a search goes on to find, and what
/// other planners do.
Plan search_on(const Model& model, const PlanOptions& options, Work& work) {
  if (!options.improve || options.planner != PlanOptions{}.planner) {
    return search_with_and_without(model, options, work);
  }
  const auto begin = std::chrono::steady_clock::now();
  PlanOptions first = options;
  first.improve = false;
  Plan plan = search_with_and_without(model, first, work);
  if (!plan.usable()) return plan;
  auto rest = with_time_left(options, begin);
  if (!rest) return plan;
  rest->time_limit *= kShareOfOwn;
  rest->nominal_if_needed = options.nominal_if_needed && !is_whole(plan);
  rest->prove = options.prove && !is_whole(plan);
  keep_better(model, search_with_and_without(model, *rest, work), plan);
  search_by_others(model, options, begin, work, plan);
  return plan;
}

Plan decide(const Model& model, const PlanOptions& options) {
  Plan plan;
  plan.start = model.scene.start;
  plan.goal = model.scene.start;
  plan.margin = options.margin.value_or(usual_margin(model));
  plan.promise = plan.margin.is_none() ? Promise::kNominal : options.promise;
  plan.planner = options.planner;
  plan.seed = options.seed;
  const std::string fault = planner_fault(options.planner, options.settings);
  if (!fault.empty()) {
    plan.status = PlanStatus::kUnsupported;
    plan.message = fault;
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
  if (model.scene.obstacles && !collisions_are_built()) {
    plan.status = PlanStatus::kUnsupported;
    plan.message =
        "the scene names obstacles, and this build has no collision library "
        "(PREHENSILE_OBSTACLES)";
    return plan;
  }
  const Proof proof = find_proof(model);
  if (proof.kind != Proof::Kind::kNone) {
    set_infeasible(plan, proof);
    return plan;
  }
  ProgressMeter meter(options.progress);
  Work work{.budget = options.budget};
  if (options.progress) work.meter = &meter;
  work.stop = options.stop;
  plan = search_on(model, options, work);
  plan.stick_tests = work.stick_tests;
  plan.propagations = work.propagations;
  plan.stopped_by = work.stopped_by;
  plan.stopped_early = plan.usable() && options.stop && options.stop->load();
  if (plan.stopped_early) plan.message = "stopped: the best plan found until then";
  return plan;
}

/// Where a plan with a margin has a gap, and does not use the room that the goal leaves.
void set_bound_at_goal(const Model& model, const Grasp& start, const Goal& goal,
                       Plan& plan) {
  plan.bound_at_goal.reset();
  const Goal itself = goal_itself(goal);
  const bool has_gap = plan.cost > kGapAsked * plan.lower_bound;
  if (!plan.margin.has_box() || !has_gap || !reaches(itself, plan.goal)) return;
  const double bound =
      lower_bound(model, start, itself, plan.cost, {.margin = plan.margin}).value;
  if (bound > plan.lower_bound) plan.bound_at_goal = bound;
}

void set_bound(const Model& model, Plan& plan) {
  const Grasp& start = model.scene.start;
  const Goal goal = goal_within_limits(model.scene);
  if (!plan.usable()) {
    plan.lower_bound = trivial_bound(model, start, goal);
    plan.bound_is_trivial = true;
    plan.bound_nodes = 0;
    return;
  }
  const LowerBound bound =
      lower_bound(model, start, goal, plan.cost, {.margin = plan.margin});
  plan.lower_bound = bound.value;
  plan.bound_is_trivial = bound.is_trivial;
  plan.bound_nodes = bound.nodes;
  set_bound_at_goal(model, start, goal, plan);
}

}  // namespace

Plan plan_regrasp(const Model& model, const PlanOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  Plan plan = decide(model, options);
  if (plan.usable()) account(model, plan);
  const bool bounded = plan.usable() || plan.status == PlanStatus::kBudgetSpent ||
                       plan.status == PlanStatus::kStopped;
  if (bounded) set_bound(model, plan);
  if (plan.usable() && is_delicate(model, plan) && !replay(model, plan).agrees) {
    set_undecided(plan, "the plan found fails as a whole with half the step");
    account(model, plan);
    set_bound(model, plan);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  plan.seconds = spent.count();
  return plan;
}

}  // namespace prehensile