#include "planner/search/push_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "planner/catalogue.h"
#include "planner/search/cheapen.h"
#include "planner/search/fallback.h"
#include "planner/search/plane_search.h"
#include "planner/steering/draft.h"
#include "planner/steering/roll_step.h"
#include "planner/walks/loop_search.h"
#include "planner/walks/walk_lattice.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr const char* kOwnPlanner = "push";

/// False if there are none.
bool append_moves(const SearchModel& search,
                  const std::optional<std::vector<Move>>& moves, Plan& plan) {
  if (!moves) return false;
  for (const Move& move : *moves) append_move(search, move, plan);
  return true;
}

/// Loops once more, of pushes that turn the object more for their way.
bool plan_by_steep_loops(const SearchModel& search, const Grasp& start, const Goal& goal,
                         WalkLattices& lattices, const Limits& limits, Work& work,
                         Plan& plan) {
  const FlatState from = flat_state(start);
  auto moves =
      search_loops(search, from, goal_places(*search.model, goal, from, search.margin),
                   tolerated_places(*search.model, goal, from), Steepness::kSteep,
                   lattices, limits, work);
  if (moves) moves = cheaper_by_pairs(search, std::move(*moves), limits, work);
  return append_moves(search, moves, plan);
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
  append_moves(search, moves, plan);
  plan.planner += std::string("+") + kFallbackPlanner;
  return true;
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
  const bool exact = append_moves(
      search, search_plane(search, start, goal, lattices, limits, work), plan);
  work.budget = whole;
  if (exact || limits.reached() || search.contacts.empty()) return exact;
  if (plan_by_fallback(search, start, goal, options, limits, of_fallback, work, plan)) {
    return true;
  }
  if (work.meter) work.meter->enter("beside the goal");
  work.budget = whole - of_steep;
  const bool beside = append_moves(
      search, search_beside_goal(search, start, goal, lattices, limits, work), plan);
  work.budget = whole;
  if (beside) return true;
  if (work.meter) work.meter->enter("steep loops");
  return plan_by_steep_loops(search, start, goal, lattices, limits, work, plan);
}

bool rolls_on_way(const SearchModel& search, Plan plan, double dpsi,
                  const PlanOptions& options) {
  return insert_roll(*search.model, dpsi, search.margin, options.transition, plan);
}

/// Where the finger axis may be to roll the object, and how the hand may be turned: along
/// the middle of a can; of a prism, whose pads have to be square to it, as high above its
/// middle as pads go, too, because low jaws hold it upright.
struct RollPlaces {
  std::vector<Vec2> p_OF;
  double first_angle = 0.0;  ///< [rad]
  int angles = 0;            ///< all around
};

RollPlaces roll_places_on(const Model& model, const Grasp& start) {
  RollPlaces places{.first_angle = start.X_HO.theta, .angles = 12};
  if (!model.prism) {
    constexpr std::array kAlong = {0.0, 0.12, -0.12, 0.25, -0.25};  // of the length
    const auto& can = std::get<CylinderShape>(model.scene.object.shape);
    const Vec2 axis = can.axis == Axis::kX ? Vec2::UnitX() : Vec2::UnitY();
    for (const double share : kAlong) places.p_OF.push_back(share * can.length * axis);
    return places;
  }
  constexpr std::array kAside = {0.9, -0.9, 0.75, -0.75, 0.6, -0.6, 0.4, -0.4};
  const LyingPrism& prism = *model.prism;
  double half_width = 0.0;
  for (const Vec2& p : model.pad_face) {
    half_width = std::max(half_width, std::abs(p.dot(prism.lateral)));
  }
  const double along = finger_in_object(start.X_HO).dot(prism.axis);
  for (const double share : kAside) {
    places.p_OF.push_back(along * prism.axis + share * half_width * prism.lateral);
  }
  places.first_angle = 0.0;
  places.angles = 4;
  return places;
}

constexpr double kSameAngle = 1e-9;  // [rad]
constexpr double kSamePlace = 1e-9;  // [m]

/// Grasps to try a roll at, those that are the shortest way from `start` first.
std::vector<Grasp> grasps_to_roll_at(const Model& model, const Grasp& start) {
  const RollPlaces places = roll_places_on(model, start);
  std::vector<Grasp> grasps;
  for (const Vec2& p_OF : places.p_OF) {
    for (int k = 0; k < places.angles; ++k) {
      const double theta = places.first_angle + 2.0 * kPi * k / places.angles;
      grasps.push_back({pose_from_finger(p_OF, wrapped(theta)), start.psi});
    }
  }
  const auto way = [&](const Grasp& grasp) {
    return flat_distance(model, flat_state(start), flat_state(grasp));
  };
  std::stable_sort(grasps.begin(), grasps.end(),
                   [&](const Grasp& a, const Grasp& b) { return way(a) < way(b); });
  return grasps;
}

/// The first of them, up to `most`, at which the object can be rolled by dpsi. Pads that
/// are turned by half a turn hold a prism as they did: what is known then is not asked.
std::vector<Grasp> roll_grasps(const SearchModel& search, const Grasp& start, double dpsi,
                               const PlanOptions& options, std::size_t most) {
  std::vector<Grasp> rolling;
  std::vector<Grasp> failing;
  for (const Grasp& grasp : grasps_to_roll_at(*search.model, start)) {
    if (rolling.size() == most) break;
    const auto holds_alike = [&](const Grasp& other) {
      const double turn = std::remainder(grasp.X_HO.theta - other.X_HO.theta, kPi);
      return search.model->prism && std::abs(turn) < kSameAngle &&
             (flat_state(grasp).p_OF - flat_state(other).p_OF).norm() < kSamePlace;
    };
    if (std::ranges::any_of(failing, holds_alike)) continue;
    Plan still;
    still.start = grasp;
    (rolls_on_way(search, still, dpsi, options) ? rolling : failing).push_back(grasp);
  }
  return rolling;
}

/// Of a prism, which few grasps let roll at all: then no way in the plane helps.
bool rolls_nowhere(const SearchModel& search, const Grasp& start, double dpsi,
                   const PlanOptions& options) {
  if (!search.model->prism || dpsi == 0.0) return false;
  return !rolls_on_way(search, blank_plan(search, start, options), dpsi, options) &&
         roll_grasps(search, start, dpsi, options, 1).empty();
}

/// A way over a place where the object can be rolled; the plan stays as it is where none
/// is found.
void go_by_roll_place(const SearchModel& search, const Goal& planar, double dpsi,
                      const PlanOptions& options, Work& work, Plan& plan) {
  constexpr std::size_t kMostPlaces = 4;  // that are planned for
  for (const Grasp& place : roll_grasps(search, plan.start, dpsi, options, kMostPlaces)) {
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

Plan search_pushes(const SearchModel& search, const Grasp& start, const Goal& goal,
                   const PlanOptions& options, Work& work) {
  Plan plan = blank_plan(search, start, options);
  const Limits limits(options, work);
  const Goal planar = planar_goal(goal);
  const double dpsi = roll_needed(goal, start.psi);
  if (rolls_nowhere(search, start, dpsi, options)) {
    say_no_roll("at any of the grasps tried", plan);
    return plan;
  }
  const bool in_plane = reaches(planar, start) ||
                        plan_in_shares(search, start, planar, options, work, plan);
  if (in_plane && dpsi != 0.0 && !rolls_on_way(search, plan, dpsi, options)) {
    go_by_roll_place(search, planar, dpsi, options, work, plan);
  }
  plan.stick_tests = work.stick_tests;
  plan.propagations = work.propagations;
  conclude_search(search, goal, options, in_plane, limits, plan);
  return plan;
}

}  // namespace prehensile
