#include "planner/push_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "planner/bounds.h"
#include "planner/catalogue.h"
#include "planner/chain_search.h"
#include "planner/cheapen.h"
#include "planner/confines.h"
#include "planner/fallback.h"
#include "planner/fan_search.h"
#include "planner/holding.h"
#include "planner/loop_search.h"
#include "planner/roll_step.h"
#include "planner/shorten.h"
#include "planner/walk_search.h"
#include "planner/wound_search.h"

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr const char* kOwnPlanner = "push";

/// The contact with the most slack for one straight move, by the real pad alone.
std::optional<Move> best_contact(const SearchModel& search, const FlatState& from,
                                 const FlatState& to, Work& work) noexcept {
  std::optional<Move> best;
  double best_slack = -kStickTolerance;
  for (std::size_t i = 0; i < search.contacts.size(); ++i) {
    const Move move{static_cast<int>(i), from, to};
    const double slack = exact_slack(search, move, work);
    if (!(slack >= -kStickTolerance)) {
      work.stopped_by.add(constraint_of(search.contacts[i], from.p_OF, to.p_OF));
    }
    if (!(slack > best_slack) || !pads_hold_gravity(search, move, work) ||
        !is_confined(search, move, work)) {
      continue;
    }
    best_slack = slack;
    best = move;
  }
  return best;
}

/// Chains and fans of the stages that know the pads themselves. `best`: the plan so far,
/// to be improved.
std::optional<std::vector<Move>> search_with_real_pads(const SearchModel& search,
                                                       const FlatState& from,
                                                       const GoalPlaces& goals,
                                                       std::optional<FoundChain> best,
                                                       const Limits& limits, Work& work) {
  const bool flat = !can_roll(search.model->scene.object);
  std::optional<PadEnvelope> envelope;
  if (flat) envelope.emplace(*search.model, search.margin);
  const PadEnvelope* pads = envelope ? &*envelope : nullptr;
  if (!best) best = search_exact_chains(search, from, goals, limits, work);
  if (!best) best = search_chains_of_real_pads(search, from, goals, pads, limits, work);
  std::optional<std::vector<Move>> moves;
  if (!best && pads) moves = search_fan(search, *pads, from, goals, limits, work);
  const double to_beat = best    ? best->chain.cost
                         : moves ? cost_of(search, *moves)
                                 : kInfinity;
  if (moves && work.meter) work.meter->found(to_beat);
  const bool is_dear = best && to_beat >= (best->chain.count > 2 ? kDear : kDearPair);
  if (limits.improves() || is_dear || (!best && !search.exact_everywhere)) {
    const auto found =
        search_long_chains(search, from, goals, pads, to_beat, limits, work);
    if (found) best = found;
  }
  if (best) moves = moves_of(search, from, best->chain);
  return moves;
}

/// Of what is left of the budget, for walks around one loop.
constexpr double kShareOfLoops = 0.7;

/// J from which one of these is looked at by cheaper_by_walk.
constexpr double kWorthWalkOfLoops = 3.0;

/// The stages that cost more, and find what the ellipsoid hides; what they find is made
/// cheaper where it is dear. `beside`: of places beside the goals, for walks around a
/// loop; null: none of these. `best`: the plan so far, to be improved.
bool plan_with_real_pads(const SearchModel& search, const FlatState& from,
                         const GoalPlaces& goals, const GoalPlaces* beside,
                         std::optional<FoundChain> best, WalkLattices& lattices,
                         const Limits& limits, Work& work, Plan& plan) {
  auto moves = search_with_real_pads(search, from, goals, std::move(best), limits, work);
  double worth_walk = kWorthWalk;
  if (!moves && beside) {
    worth_walk = kWorthWalkOfLoops;
    moves = within_budget(work, share_of_left(work, kShareOfLoops), [&] {
      return search_loops(search, from, goals, *beside, Steepness::kUsual, lattices,
                          limits, work);
    });
  }
  const bool is_walk = !moves;
  if (is_walk) {
    moves = search_walks(search, from, goals, kInfinity, lattices, limits, work);
  }
  if (!moves) return false;
  moves = cheaper_by_pairs(search, std::move(*moves), limits, work);
  if (!is_walk) {
    moves = cheaper_by_walk(search, from, goals, std::move(*moves), worth_walk, lattices,
                            limits, work);
  }
  for (const Move& move : *moves) append_move(search, move, plan);
  return true;
}

/// Over whole discs only, where the search knows the pads: elsewhere plans to the goal
/// itself fail their exact check often enough. One straight push to a place beside the
/// goal, or two by way of a crossing of cone lines.
std::optional<std::vector<Move>> search_within_tolerance(const SearchModel& search,
                                                         const FlatState& from,
                                                         const Goal& goal,
                                                         const Limits& limits,
                                                         Work& work) {
  if (!search.exact_everywhere) return std::nullopt;
  const GoalPlaces places = tolerated_places(*search.model, goal, from);
  if (const auto move = direct_push(search, from, places, work)) {
    return std::vector{*move};
  }
  const auto found = search_crossings(search, from, places, limits, work);
  if (!found) return std::nullopt;
  return moves_of(search, from, found->chain);
}

/// Fills the pushes in the pad plane; false if none were found.
bool plan_in_plane(const SearchModel& search, const Grasp& start, const Goal& goal,
                   WalkLattices& lattices, const Limits& limits, Work& work, Plan& plan) {
  const FlatState from = flat_state(start);
  const GoalPlaces goals = goal_places(*search.model, goal, from);
  if (const auto move = direct_push(search, from, goals, work)) {
    append_move(search, *move, plan);
    return true;
  }
  const double bound = guide_bound(*search.model, start, goal);
  if (work.meter) work.meter->bound(trivial_bound(*search.model, start, goal));
  const auto found = search_chains(search, from, goals, bound, limits, work);
  if (const auto near = search_within_tolerance(search, from, goal, limits, work)) {
    const double to_beat = found ? kWorthTolerance * found->chain.cost : kInfinity;
    if (cost_of(search, *near) < to_beat) {
      for (const Move& move : *near) append_move(search, move, plan);
      return true;
    }
  }
  if (!found && !limits.improves() && !limits.reached()) {
    if (const auto wound = search_wound(search, from, goal, goals, bound, limits, work)) {
      for (const Move& move : *wound) append_move(search, move, plan);
      return true;
    }
  }
  const double enough = limits.improves() ? kGoodEnough * bound : kDearPair;
  if (found && found->chain.cost <= enough) {
    append_chain(search, from, found->chain, plan);
    return true;
  }
  const GoalPlaces beside = tolerated_places(*search.model, goal, from);
  return plan_with_real_pads(search, from, goals, &beside, found, lattices, limits, work,
                             plan);
}

/// The stages of more than two pushes once more, to places that are off the goal by up to
/// its tolerances.
bool plan_beside_goal(const SearchModel& search, const Grasp& start, const Goal& goal,
                      WalkLattices& lattices, const Limits& limits, Work& work,
                      Plan& plan) {
  const FlatState from = flat_state(start);
  const GoalPlaces places = tolerated_places(*search.model, goal, from);
  if (places.count == 0) return false;
  const double bound = guide_bound(*search.model, start, goal);
  const auto found = search_chains(search, from, places, bound, limits, work);
  return plan_with_real_pads(search, from, places, nullptr, found, lattices, limits, work,
                             plan);
}

/// Loops once more, of pushes that turn the object more for their way.
bool plan_by_steep_loops(const SearchModel& search, const Grasp& start, const Goal& goal,
                         WalkLattices& lattices, const Limits& limits, Work& work,
                         Plan& plan) {
  const FlatState from = flat_state(start);
  auto moves = search_loops(search, from, goal_places(*search.model, goal, from),
                            tolerated_places(*search.model, goal, from),
                            Steepness::kSteep, lattices, limits, work);
  if (!moves) return false;
  moves = cheaper_by_pairs(search, std::move(*moves), limits, work);
  for (const Move& move : *moves) append_move(search, move, plan);
  return true;
}

/// A baseline with work of its own.
bool plan_by_fallback(const SearchModel& search, const Grasp& start, const Goal& goal,
                      const PlanOptions& options, const Limits& limits,
                      std::int64_t budget, Work& work, Plan& plan) {
  if (budget <= 0) return false;
  if (work.meter) work.meter->enter("fallback");
  auto moves = fall_back(search, start, goal, options, budget, work);
  if (!moves) return false;
  moves = cheaper_by_pairs(search, std::move(*moves), limits, work);
  for (const Move& move : *moves) append_move(search, move, plan);
  plan.planner += std::string("+") + kFallbackPlanner;
  return true;
}

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

/// Of the budget, for steep loops.
constexpr double kShareOfSteepLoops = 0.1;

/// The exact stages with their share of the budget, then the fallback with its own, with
/// what is left the places beside a goal that no way leads to, and then steep loops with
/// theirs.
bool plan_in_shares(const SearchModel& search, const Grasp& start, const Goal& goal,
                    const PlanOptions& options, Work& work, Plan& plan) {
  const Limits limits(options, work);
  WalkLattices lattices;
  const double share = setting(
      *find_planner(kOwnPlanner), options.settings,
      search.model->scene.obstacles ? "fallback_share_obstacles" : "fallback_share");
  const std::int64_t whole = work.budget;
  const std::int64_t of_fallback = share_of_left(work, share);
  const std::int64_t of_steep =
      search.model->scene.obstacles ? 0 : share_of_left(work, kShareOfSteepLoops);
  work.budget = whole - of_fallback - of_steep;
  const bool exact = plan_in_plane(search, start, goal, lattices, limits, work, plan);
  work.budget = whole;
  if (exact || limits.reached() || search.contacts.empty()) return exact;
  if (plan_by_fallback(search, start, goal, options, limits, of_fallback, work, plan)) {
    return true;
  }
  if (work.meter) work.meter->enter("beside the goal");
  work.budget = whole - of_steep;
  const bool beside = plan_beside_goal(search, start, goal, lattices, limits, work, plan);
  work.budget = whole;
  if (beside) return true;
  if (work.meter) work.meter->enter("steep loops");
  return plan_by_steep_loops(search, start, goal, lattices, limits, work, plan);
}

bool rolls_on_way(const SearchModel& search, Plan plan, double dpsi,
                  const PlanOptions& options) {
  return insert_roll(*search.model, dpsi, search.margin, options.transition, plan);
}

/// Grasps at which the object can be rolled by dpsi: along the middle of a can, at angles
/// all around; first those that are the shortest way from `start`.
std::vector<Grasp> roll_places(const SearchModel& search, const Grasp& start, double dpsi,
                               const PlanOptions& options) {
  constexpr std::array kAlong = {0.0, 0.12, -0.12, 0.25, -0.25};  // of the length
  constexpr int kAngles = 12;
  const auto& can = std::get<CylinderShape>(search.model->scene.object.shape);
  const Vec2 axis = can.axis == Axis::kX ? Vec2::UnitX() : Vec2::UnitY();
  std::vector<Grasp> grasps;
  for (const double share : kAlong) {
    for (int k = 0; k < kAngles; ++k) {
      const double theta = start.X_HO.theta + 2.0 * std::numbers::pi * k / kAngles;
      Plan still;
      still.start = {pose_from_finger(share * can.length * axis, wrapped(theta)),
                     start.psi};
      if (rolls_on_way(search, still, dpsi, options)) grasps.push_back(still.start);
    }
  }
  const auto way = [&](const Grasp& grasp) {
    return flat_distance(*search.model, flat_state(start), flat_state(grasp));
  };
  std::stable_sort(grasps.begin(), grasps.end(),
                   [&](const Grasp& a, const Grasp& b) { return way(a) < way(b); });
  return grasps;
}

/// A way over a place where the object can be rolled; the plan stays as it is where none
/// is found.
void go_by_roll_place(const SearchModel& search, const Goal& planar, double dpsi,
                      const PlanOptions& options, Work& work, Plan& plan) {
  constexpr std::size_t kMostPlaces = 4;  // that are planned for
  std::vector<Grasp> places = roll_places(search, plan.start, dpsi, options);
  if (places.size() > kMostPlaces) places.resize(kMostPlaces);
  for (const Grasp& place : places) {
    const PlanarPose& X_HO = place.X_HO;
    Goal there = planar;
    there.x = X_HO.x;
    there.y = X_HO.y;
    there.theta = X_HO.theta;
    Plan detour = blank_plan(search, plan.start, options);
    const bool arrives = reaches(there, plan.start) ||
                         plan_in_shares(search, plan.start, there, options, work, detour);
    if (arrives && plan_in_shares(search, detour.goal, planar, options, work, detour) &&
        rolls_on_way(search, detour, dpsi, options)) {
      plan = std::move(detour);
      return;
    }
  }
}

}  // namespace

std::optional<Move> direct_push(const SearchModel& search, const FlatState& start,
                                const GoalPlaces& goals, Work& work) noexcept {
  std::optional<Move> best;
  double best_distance = kInfinity;
  for (int i = 0; i < goals.count; ++i) {
    const GoalPlace& place = goals.places[i];
    bool on_object = false;
    for (int j = 0; j < place.count; ++j) {
      const FlatState end{place.p_OF, place.theta[j]};
      const double distance = flat_distance(*search.model, start, end);
      if (distance >= best_distance) continue;
      on_object = on_object || path_on_object(*search.model, {start.p_OF, true},
                                              {place.p_OF, true}, search.margin);
      if (!on_object) break;
      if (const auto move = best_contact(search, start, end, work)) {
        best = move;
        best_distance = distance;
      }
    }
  }
  return best;
}

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

void conclude_search(const SearchModel& search, const Goal& goal,
                     const PlanOptions& options, bool found, const Limits& limits,
                     Plan& plan) {
  if (!found) return say_undecided(limits, plan);
  const double dpsi = roll_needed(goal, plan.start.psi);
  if (dpsi != 0.0 &&
      !insert_roll(*search.model, dpsi, search.margin, options.transition, plan)) {
    plan.status = PlanStatus::kBudgetSpent;
    plan.message = "no contact rolls the object at any pose of the plan";
    plan.pushes.clear();
    return;
  }
  plan.status = PlanStatus::kReachedGoal;
}

void append_chain(const SearchModel& search, const FlatState& start, const Chain& chain,
                  Plan& plan) {
  for (const Move& move : moves_of(search, start, chain)) append_move(search, move, plan);
}

Plan search_pushes(const SearchModel& search, const Grasp& start, const Goal& goal,
                   const PlanOptions& options, Work& work) {
  Plan plan = blank_plan(search, start, options);
  const Limits limits(options, work);
  const Goal planar = planar_goal(goal);
  const bool in_plane = reaches(planar, start) ||
                        plan_in_shares(search, start, planar, options, work, plan);
  const double dpsi = roll_needed(goal, start.psi);
  if (in_plane && dpsi != 0.0 && !rolls_on_way(search, plan, dpsi, options)) {
    go_by_roll_place(search, planar, dpsi, options, work, plan);
  }
  plan.stick_tests = work.stick_tests;
  plan.propagations = work.propagations;
  conclude_search(search, goal, options, in_plane, limits, plan);
  return plan;
}

}  // namespace prehensile
