#include "planner/search/checked_search.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>
#include <vector>

#include "planner/baselines/baselines.h"
#include "planner/bounds/bounds.h"
#include "planner/catalogue.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/meet_end.h"
#include "planner/costs.h"
#include "planner/finish/finish.h"
#include "planner/search/frame.h"
#include "planner/search/push_search.h"
#include "planner/steering/confines.h"
#include "planner/steering/draft.h"

namespace prehensile {
namespace {

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

/// What one search keeps clear of, and what its plan must then survive.
struct Clearance {
  Margin margin;
  double extra_grasp = 0.0;        ///< [m] for what longer ways carry the finger axis off
  double extra_friction = 0.0;     ///< share of the pusher's friction that is left unused
  bool looks_for_cheaper = false;  ///< see SearchModel
  int left_out = -1;               ///< contact that makes no push; -1: none
  bool points_stay = false;        ///< see SearchModel
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

/// Each once.
std::vector<int> contacts_of(const Plan& plan) {
  std::vector<int> contacts;
  for (const PlannedPush& push : plan.pushes) {
    const int contact = contact_of(push.push);
    if (std::ranges::find(contacts, contact) == contacts.end())
      contacts.push_back(contact);
  }
  return contacts;
}

/// Of the work and the time of a search that goes on until they are spent, for the polish
/// and the check of what it found.
constexpr double kShareOfFinish = 0.1;

Plan search_with_share(const SearchModel& search, const PlanOptions& options,
                       Work& work) {
  if (!options.improve) return search_plan(search, options, work);
  PlanOptions share = options;
  share.time_limit *= 1.0 - kShareOfFinish;
  return within_budget(work, share_of_left(work, 1.0 - kShareOfFinish),
                       [&] { return search_plan(search, share, work); });
}

/// One search, finished and checked.
Plan attempt(const Model& model, const PlanOptions& options, const Clearance& clearance,
             Work& work, Found& found) {
  Margin kept = clearance.margin;
  kept.grasp += clearance.extra_grasp;
  kept.friction = std::min(1.0, kept.friction + clearance.extra_friction);
  SearchModel search = prepare_search(model, kept, clearance.left_out);
  search.looks_for_cheaper = clearance.looks_for_cheaper;
  search.points_stay = clearance.points_stay;
  if (options.beside_goal) search.may_end_beside = true;
  if (work.meter) {
    work.meter->enter(kept.is_none() ? "search without margin" : "search");
    work.meter->forget_best();
    work.meter->bound(trivial_bound(model, model.scene.start, *model.scene.goal));
  }
  if (search.contacts.empty()) {
    Plan plan = blank_plan(search, model.scene.start, options);
    if (model.F > 0.0 && model.c > 0.0) {
      set_undecided(plan, "the margin leaves no pusher a place on its face");
    } else {
      plan.status = PlanStatus::kUnsupported;
      plan.message =
          model.F > 0.0
              ? "nothing can be pushed: pads that are points resist no turning "
                "(gripper.pad: soft_point does, and any pad with an extent)"
              : "nothing can be pushed: the fingers have no friction or no grip "
                "(gripper.friction, gripper.grip_force)";
    }
    return plan;
  }
  const Limits limits(options, work);
  Plan plan = search_with_share(search, options, work);
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

/// [m] of the finger axis: what a nominal search keeps clear of slipping by where a plan
/// on the very border fails its check.
constexpr double kClearOfBorder = 0.2e-3;

/// Shares of the friction that further searches leave unused: what the points of the pads
/// do to an object that turns about a point of the pusher is known along its way only.
constexpr std::array kUnusedFriction = {0.1, 0.25};

/// A plan that is repaired and costs so much and more need not be the cheapest by far.
constexpr double kDearRepair = 5.0;

}  // namespace

void set_undecided(Plan& plan, std::string message) {
  plan.status = PlanStatus::kBudgetSpent;
  plan.message = std::move(message);
  plan.pushes.clear();
}

Plan search_and_check(const Model& model, const PlanOptions& options,
                      const Margin& margin, Work& work, Found& found, Asked asked) {
  const auto begin = std::chrono::steady_clock::now();
  work.found_cheaper = 0;
  Plan plan =
      attempt(model, options, {.margin = margin, .looks_for_cheaper = true}, work, found);
  const std::vector<int> contacts = contacts_of(found.plan);
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
  if (failed_check() && has_pushes_by_points(model, found.plan)) {
    again({.margin = margin, .looks_for_cheaper = true, .points_stay = true},
          "; with more pushes by points: ");
  }
  if (failed_check() && work.found_cheaper > 0) {
    again({margin}, "; the first that is found: ");
  }
  if (failed_check() && found.drift > 0.0) {
    again({margin, 1.5 * found.drift}, "; with more room for drift: ");
  }
  if (failed_check() && margin.is_none()) {
    again({margin, kClearOfBorder}, "; a little clear of slipping: ");
  } else if (failed_check() && asked == Asked::kWholeMargin) {
    again({margin.scaled(2.0)}, "; with double the margin: ");
    if (plan.usable()) {
      plan.message =
          "planned for double the margin: what was found for the margin itself fails its "
          "exact check";
    }
  }
  for (const double unused : kUnusedFriction) {
    if (!failed_check()) break;
    again({margin, kClearOfBorder, unused}, "; with friction to spare: ");
  }
  for (const int contact : contacts) {
    if (!failed_check()) break;
    again({.margin = margin, .looks_for_cheaper = true, .left_out = contact},
          "; without one contact: ");
  }
  return plan;
}

}  // namespace prehensile
