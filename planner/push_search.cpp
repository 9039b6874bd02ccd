#include "planner/push_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/label_search.h"
#include "planner/lattice.h"
#include "planner/roll_step.h"

namespace prehensile {
namespace {

/// A plan this close to the bound for two placements is not worth a search for better
/// ones.
constexpr double kGoodEnough = 1.05;

constexpr int kCoarseNodes = 200;
constexpr int kFineNodes = 800;

double flat_distance(const SearchModel& search, const FlatState& a, const FlatState& b) {
  return std::hypot((b.p_OF - a.p_OF).norm(), search.model->c * (b.theta - a.theta));
}

bool both_ends_held(const SearchModel& search, const Move& move) {
  const Vec2& g_O = search.model->contacts[search.contacts[move.contact].contact].g_O;
  return holding_slack(*search.model, move.from.p_OF, g_O, Margin::none()) > 0.0 &&
         holding_slack(*search.model, move.to.p_OF, g_O, Margin::none()) > 0.0;
}

/// The contact with the most slack for one straight move, by the real pad alone.
std::optional<Move> best_contact(const SearchModel& search, const FlatState& from,
                                 const FlatState& to, Work& work) noexcept {
  std::optional<Move> best;
  double best_slack = -kStickTolerance;
  for (std::size_t i = 0; i < search.contacts.size(); ++i) {
    const Move move{static_cast<int>(i), from, to};
    if (!both_ends_held(search, move)) continue;
    const double slack = exact_slack(search, move, work);
    if (!(slack > best_slack)) continue;
    best_slack = slack;
    best = move;
  }
  return best;
}

std::optional<FoundChain> chain_through(const SearchModel& search, const FlatState& start,
                                        const GoalPlaces& goals, const WayPoint& point,
                                        Work& work) {
  FoundChain found{{}, point.place, point.angle};
  const GoalPlace& goal = goals.places[point.place];
  Chain& chain = found.chain;
  chain.count = 2;
  const bool possible = make_leg(search, point.first, {start.p_OF, true}, {point.p_OF},
                                 work, chain.legs[0]) &&
                        make_leg(search, point.second, {point.p_OF}, {goal.p_OF, true},
                                 work, chain.legs[1]) &&
                        solve_chain(search, goal.theta[point.angle] - start.theta, chain);
  if (!possible) return std::nullopt;
  if (chain_slack(search, chain, start.theta, work) < -kStickTolerance) {
    return std::nullopt;
  }
  return found;
}

/// The cheapest of the way-points whose two pushes stick with the real pad.
std::optional<FoundChain> first_that_sticks(const SearchModel& search,
                                            const FlatState& start,
                                            const GoalPlaces& goals,
                                            const BestWayPoints& points, Work& work) {
  for (int i = 0; i < points.count(); ++i) {
    if (auto found = chain_through(search, start, goals, points[i], work)) return found;
  }
  return std::nullopt;
}

bool good_enough(const SearchModel& search, const FlatState& start,
                 const GoalPlaces& goals, const std::optional<FoundChain>& found) {
  if (!found) return false;
  const GoalPlace& nearest = goals.places[0];
  const double distance = flat_distance(search, start, {nearest.p_OF, nearest.theta[0]});
  return found->chain.cost <= kGoodEnough * (2.0 + distance / search.model->L);
}

/// Stages of growing effort; none of them is entered once a plan is good enough.
std::optional<FoundChain> search_chains(const SearchModel& search, const FlatState& start,
                                        const GoalPlaces& goals, const Limits& limits,
                                        Work& work) {
  BestWayPoints points;
  for (int place = 0; place < goals.count && !limits.reached(); ++place) {
    add_crossings(search, start, goals, place, work, points);
  }
  auto found = first_that_sticks(search, start, goals, points, work);
  if (good_enough(search, start, goals, found) || limits.reached()) return found;

  const std::vector<Vec2> nodes = lattice_nodes(search, kCoarseNodes);
  add_nodes(search, nodes, start, goals, work, points);
  found = first_that_sticks(search, start, goals, points, work);
  if (found || limits.reached()) return found;

  found = search_labels(search, nodes, start, goals, limits, work);
  if (found || limits.reached()) return found;
  return search_labels(search, lattice_nodes(search, kFineNodes), start, goals, limits,
                       work);
}

void append_chain(const SearchModel& search, const FlatState& start, const Chain& chain,
                  Plan& plan) {
  double theta = start.theta;
  for (int k = 0; k < chain.count; ++k) {
    const Move move = move_of(search, chain, k, theta);
    append_move(search, move, plan);
    theta = move.to.theta;
  }
}

/// Fills the pushes in the pad plane; false if none were found.
bool plan_in_plane(const SearchModel& search, const Grasp& start, const Goal& goal,
                   const Limits& limits, Work& work, Plan& plan) {
  const FlatState from = flat_state(start);
  const GoalPlaces goals = goal_places(*search.model, goal, from);
  if (const auto move = direct_push(search, from, goals, work)) {
    append_move(search, *move, plan);
    return true;
  }
  const auto found = search_chains(search, from, goals, limits, work);
  if (!found) return false;
  append_chain(search, from, found->chain, plan);
  return true;
}

void say_undecided(const Limits& limits, Plan& plan) {
  plan.status = limits.stopped() ? PlanStatus::kStopped : PlanStatus::kBudgetSpent;
  plan.message =
      limits.stopped()       ? "stopped before a plan was found"
      : limits.out_of_time() ? "no plan found within the time limit"
      : limits.reached()
          ? "no plan found within the work budget"
          : "every stage of the search ended without a plan within the margin; a "
            "smaller margin may admit one";
}

}  // namespace

std::optional<Move> direct_push(const SearchModel& search, const FlatState& start,
                                const GoalPlaces& goals, Work& work) noexcept {
  std::optional<Move> best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < goals.count; ++i) {
    const GoalPlace& place = goals.places[i];
    bool on_object = false;
    for (int j = 0; j < place.count; ++j) {
      const FlatState end{place.p_OF, place.theta[j]};
      const double distance = flat_distance(search, start, end);
      if (distance >= best_distance) continue;
      on_object = on_object || segment_on_object(*search.model, start.p_OF, place.p_OF);
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

Plan search_pushes(const SearchModel& search, const Grasp& start, const Goal& goal,
                   const PlanOptions& options, Work& work) {
  Plan plan = blank_plan(search, start, options);
  const Limits limits(options, work);
  const Goal planar = planar_goal(goal);
  const bool in_plane =
      reaches(planar, start) || plan_in_plane(search, start, planar, limits, work, plan);
  plan.stick_tests = work.stick_tests;
  if (!in_plane) {
    say_undecided(limits, plan);
    return plan;
  }
  const double dpsi = roll_needed(goal, start.psi);
  if (dpsi != 0.0 &&
      !insert_roll(*search.model, dpsi, search.margin, options.transition, plan)) {
    plan.status = PlanStatus::kBudgetSpent;
    plan.message = "no contact rolls the object at any pose of the plan";
    return plan;
  }
  plan.status = PlanStatus::kReachedGoal;
  return plan;
}

}  // namespace prehensile
