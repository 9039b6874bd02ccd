#include "planner/planner.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include "planner/baselines.h"
#include "planner/bounds.h"
#include "planner/catalogue.h"
#include "planner/confines.h"
#include "planner/costs.h"
#include "planner/exact_check.h"
#include "planner/finish.h"
#include "planner/frame.h"
#include "planner/meet_end.h"
#include "planner/push_search.h"
#include "planner/refuse.h"
#include "planner/replay.h"
#include "planner/spread_pads.h"
#include "primitives/uncertainty.h"

namespace prehensile {
namespace {

/// Of a time limit, for plans with a margin and for a barrier; the rest is for plans
/// without.
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

Plan search_plan(const SearchModel& search, const PlanOptions& options, Work& work) {
  const Scene& scene = search.model->scene;
  const Goal goal = goal_within_limits(scene);
  if (find_planner(options.planner)->family == PlannerFamily::kBaseline) {
    return search_by_baseline(search, scene.start, goal, options, work);
  }
  if (frame_is_built()) {
    return solve_in_frame(search, scene.start, goal, options, work);
  }
  return search_pushes(search, scene.start, goal, options, work);
}

void set_undecided(Plan& plan, std::string message) {
  plan.status = PlanStatus::kBudgetSpent;
  plan.message = std::move(message);
  plan.pushes.clear();
}

/// What one search keeps clear of, and what its plan must then survive.
struct Clearance {
  Margin margin;
  double extra_grasp = 0.0;        ///< [m] for what longer ways carry the finger axis off
  double extra_friction = 0.0;     ///< share of the pusher's friction that is left unused
  bool looks_for_cheaper = false;  ///< see SearchModel
};

/// By how much the ways of a plan carry the finger axis further off than the straight
/// ones that the search counts with [m].
double uncounted_drift(const Model& model, const Plan& plan) {
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  double travelled = 0.0;
  double most = 0.0;
  for (const PlannedPush& push : plan.pushes) {
    const double straight = (finger_in_object(push.start.X_HO) - start).norm();
    most = std::max(most, travelled - straight);
    travelled += travel_in_pad_plane(push.push);
  }
  return plan.margin.tilt * most;
}

/// What a search found before anything was checked.
struct Found {
  Plan plan;
  double drift = 0.0;  ///< [m] see above
  bool is_repaired = false;
};

/// One search, finished and checked.
Plan attempt(const Model& model, const PlanOptions& options, const Clearance& clearance,
             Work& work, Found& found) {
  Margin kept = clearance.margin;
  kept.grasp += clearance.extra_grasp;
  kept.friction = std::min(1.0, kept.friction + clearance.extra_friction);
  SearchModel search = prepare_search(model, kept);
  search.looks_for_cheaper = clearance.looks_for_cheaper;
  if (work.meter) {
    work.meter->enter(kept.is_none() ? "search without margin" : "search");
    work.meter->forget_best();
  }
  if (search.contacts.empty()) {
    Plan plan = blank_plan(search, model.scene.start, options);
    if (model.F > 0.0 && model.c > 0.0) {
      set_undecided(plan, "the margin leaves no pusher a place on its face");
    } else {
      plan.status = PlanStatus::kUnsupported;
      plan.message =
          "nothing can be pushed: the pads have no friction, no grip or no torque";
    }
    return plan;
  }
  const Limits limits(options, work);
  Plan plan = search_plan(search, options, work);
  plan.margin = clearance.margin;
  found.drift = uncounted_drift(model, plan);
  if (plan.status == PlanStatus::kReachedGoal) {
    found.plan = plan;
    const Finished finished = finish(search, options, limits, work, plan);
    found.is_repaired = finished.is_repaired;
    if (!finished.fault.empty()) {
      set_undecided(plan, "the plan found fails its exact check: " + finished.fault);
    }
    if (plan.usable() && !reaches(*model.scene.goal, plan.goal)) {
      set_undecided(plan, "the plan found ends beside the goal");
    }
  }
  return plan;
}

using Clock = std::chrono::steady_clock;

/// The options with what is left of their time limit; nothing if none is. Without a limit
/// the clock decides nothing.
std::optional<PlanOptions> with_time_left(const PlanOptions& options,
                                          Clock::time_point begin) {
  PlanOptions rest = options;
  if (options.time_limit <= 0.0) return rest;
  rest.time_limit -= std::chrono::duration<double>(Clock::now() - begin).count();
  if (rest.time_limit <= 0.0) return std::nullopt;
  return rest;
}

/// [m] of the finger axis: what a nominal search keeps clear of slipping by where a plan
/// on the very border fails its check.
constexpr double kClearOfBorder = 0.2e-3;

/// Shares of the friction that further searches leave unused: what the points of the pads
/// do to an object that turns about a point of the pusher is known along its way only.
constexpr std::array kUnusedFriction = {0.1, 0.25};

/// A plan that is repaired and costs so much and more need not be the cheapest by far.
constexpr double kDearRepair = 5.0;

/// A plan that fails its exact check is searched again, first without a look for what is
/// cheaper than the first plan found, if it took its place, then farther from slipping by
/// what its detours carry the finger axis off, then with double the margin, then with
/// less friction than there is. A dear one that passes once it is repaired is searched
/// again once, and the cheaper is kept.
Plan search_and_check(const Model& model, const PlanOptions& options,
                      const Margin& margin, Work& work, Found& found) {
  const auto begin = Clock::now();
  work.found_cheaper = 0;
  Plan plan =
      attempt(model, options, {.margin = margin, .looks_for_cheaper = true}, work, found);
  const auto failed_check = [&] { return plan.instants > 0 && !plan.usable(); };
  const auto again = [&](const Clearance& clearance, const char* how) {
    const auto rest = with_time_left(options, begin);
    if (!rest) return;
    Plan other = attempt(model, *rest, clearance, work, found);
    other.instants += plan.instants;
    if (!other.usable()) {
      plan.instants = other.instants;
      if (!plan.usable()) plan.message += how + other.message;
      return;
    }
    account(model, other);
    plan.instants = other.instants;
    if (!plan.usable() || other.cost < plan.cost) plan = std::move(other);
  };
  if (plan.usable()) {
    account(model, plan);
    if (found.is_repaired && plan.cost >= kDearRepair) {
      again({margin, std::max(1.5 * found.drift, kClearOfBorder)}, "");
    }
    return plan;
  }
  if (failed_check() && work.found_cheaper > 0) {
    again({margin}, "; the first that is found: ");
  }
  if (failed_check() && found.drift > 0.0) {
    again({margin, 1.5 * found.drift}, "; with more room for drift: ");
  }
  if (failed_check() && margin.is_none()) {
    again({margin, kClearOfBorder}, "; a little clear of slipping: ");
  } else if (failed_check()) {
    again({margin.scaled(2.0)}, "; with double the margin: ");
  }
  for (const double unused : kUnusedFriction) {
    if (!failed_check()) break;
    again({margin, kClearOfBorder, unused}, "; with friction to spare: ");
  }
  return plan;
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

/// With the margin; if that finds nothing, a barrier is looked for, and if there is none
/// either, a plan without margin; where a barrier takes longer than that, the plan first.
Plan search_with_and_without(const Model& model, const PlanOptions& options, Work& work) {
  const Margin margin = options.margin.value_or(usual_margin(model));
  const bool nominal = margin.is_none();
  const bool falls_back = options.nominal_if_needed && !nominal;
  PlanOptions robust = options;
  robust.time_limit *= falls_back ? kShareOfTime : 1.0 - kShareOfProof;
  if (falls_back) {
    work.budget = work.done() + work_with_margin(options);
  }
  Found found;
  Plan plan = search_and_check(model, robust, margin, work, found);
  plan.promise = nominal ? Promise::kNominal : options.promise;
  const bool undecided =
      plan.status == PlanStatus::kBudgetSpent || plan.status == PlanStatus::kStopped;
  if (!undecided) return plan;
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
  without.message = "no plan was found that survives the margin (" + plan.message +
                    "); this one is nominal: it holds for the values of the scene only";
  return without;
}

/// With `improve`: what is found without it, and what a search goes on to find, whichever
/// is cheaper.
Plan search_on(const Model& model, const PlanOptions& options, Work& work) {
  if (!options.improve || options.planner != PlanOptions{}.planner) {
    return search_with_and_without(model, options, work);
  }
  const auto begin = Clock::now();
  PlanOptions first = options;
  first.improve = false;
  Plan plan = search_with_and_without(model, first, work);
  if (!plan.usable()) return plan;
  const auto rest = with_time_left(options, begin);
  if (!rest) return plan;
  Plan better = search_with_and_without(model, *rest, work);
  if (!better.usable()) return plan;
  if (better.promise != plan.promise) {
    return better.promise == Promise::kNominalOnly ? plan : better;
  }
  account(model, plan);
  account(model, better);
  return better.cost < plan.cost ? better : plan;
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

void set_bound(const Model& model, Plan& plan) {
  const Grasp& start = model.scene.start;
  const Goal goal = goal_within_limits(model.scene);
  if (!plan.usable()) {
    plan.lower_bound = trivial_bound(model, start, goal);
    return;
  }
  const LowerBound bound =
      lower_bound(model, start, goal, plan.cost, {.weightless = plan.margin.weightless});
  plan.lower_bound = bound.value;
  plan.bound_is_trivial = bound.is_trivial;
  plan.bound_nodes = bound.nodes;
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
    set_bound(model, plan);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  plan.seconds = spent.count();
  return plan;
}

}  // namespace prehensile
