#include "planner/search/plane_search.h"

#include <algorithm>
#include <utility>

#include "planner/bounds/bounds.h"
#include "planner/chains/best_moves.h"
#include "planner/chains/chain_search.h"
#include "planner/chains/direct_push.h"
#include "planner/chains/fan_search.h"
#include "planner/chains/scattered_push.h"
#include "planner/chains/shorten.h"
#include "planner/search/cheapen.h"
#include "planner/search/wound_search.h"
#include "planner/steering/roll_step.h"
#include "planner/walks/loop_search.h"
#include "planner/walks/walk_search.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

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
  if (!best) {
    best = search_chains_of_real_pads(search, from, goals, pads, kInfinity, limits, work);
  }
  std::optional<std::vector<Move>> moves;
  if (!best && pads) moves = search_fan(search, *pads, from, goals, limits, work);
  const double to_beat = best    ? best->chain.cost
                         : moves ? cost_of(search, *moves)
                                 : kInfinity;
  if (moves && work.meter) work.meter->found(to_beat);
  const bool is_dear = best && best->is_near_least() &&
                       to_beat >= (best->chain.count > 2 ? kDear : kDearPair);
  if (limits.improves() || is_dear || (!best && !search.exact_everywhere)) {
    const auto found =
        search_long_chains(search, from, goals, pads, to_beat, limits, work);
    if (found) best = found;
  }
  if (best) moves = moves_of(search, from, best->chain);
  return moves;
}

/// Cost over the guide bound from which plans of many turns are looked for.
constexpr double kWorthWinding = 2.0;

/// Of what is left of the budget, for walks around one loop.
constexpr double kShareOfLoops = 0.7;

/// J from which one of these is looked at by cheaper_by_walk.
constexpr double kWorthWalkOfLoops = 3.0;

/// The stages that cost more, and find what the ellipsoid hides; what they find is made
/// cheaper where it is dear. `beside`: of places beside the goals, for walks around a
/// loop; null: none of these. `best`: the plan so far, to be improved.
std::optional<std::vector<Move>> longer_moves(
    const SearchModel& search, const FlatState& from, const GoalPlaces& goals,
    const GoalPlaces* beside, std::optional<FoundChain> best, WalkLattices& lattices,
    const Limits& limits, Work& work) {
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
  if (!moves) return std::nullopt;
  moves = cheaper_by_pairs(search, std::move(*moves), limits, work);
  if (!is_walk) {
    moves = cheaper_by_walk(search, from, goals, std::move(*moves), worth_walk, lattices,
                            limits, work);
  }
  return moves;
}

/// Over whole discs only, where the search knows the pads: elsewhere plans to the goal
/// itself fail their exact check often enough. One straight push to a place beside the
/// goal, or two cheaper than `to_beat` by way of a crossing of cone lines.
std::optional<std::vector<Move>> search_within_tolerance(const SearchModel& search,
                                                         const FlatState& from,
                                                         const Goal& goal, double to_beat,
                                                         const Limits& limits,
                                                         Work& work) {
  if (!search.exact_everywhere) return std::nullopt;
  const GoalPlaces places = tolerated_places(*search.model, goal, from);
  if (const auto move = direct_push(search, from, places, work)) {
    return std::vector{*move};
  }
  const auto found = search_crossings(search, from, places, to_beat, limits, work);
  if (!found) return std::nullopt;
  return moves_of(search, from, found->chain);
}

/// Whether no goal is much nearer than the one that a push leads to.
bool goes_straight(const SearchModel& search, const GoalPlaces& goals, const Move& move) {
  double least = kInfinity;
  for (int i = 0; i < goals.count; ++i) {
    const GoalPlace& place = goals.places[static_cast<std::size_t>(i)];
    if (place.count == 0) continue;
    const FlatState nearest{place.p_OF, place.theta[0]};
    least = std::min(least, flat_distance(*search.model, move.from, nearest));
  }
  return flat_distance(*search.model, move.from, move.to) <= kGoodEnough * least;
}

}  // namespace

std::optional<std::vector<Move>> search_plane(const SearchModel& search,
                                              const Grasp& start, const Goal& goal,
                                              WalkLattices& lattices,
                                              const Limits& limits, Work& work) {
  const FlatState from = flat_state(start);
  const GoalPlaces goals = goal_places(*search.model, goal, from, search.margin);
  auto direct = direct_push(search, from, goals, work);
  if (direct && !search.looks_for_cheaper) return std::vector{*direct};
  const double way =
      direct ? flat_distance(*search.model, direct->from, direct->to) : kInfinity;
  const auto shorter = scattered_push(search, from, goal, way, work);
  if (shorter) direct = shorter;
  if (direct && goes_straight(search, goals, *direct)) return std::vector{*direct};
  BestMoves best(search);
  if (direct) best.offer({*direct});
  const double bound = guide_bound(*search.model, start, goal);
  if (work.meter) work.meter->bound(trivial_bound(*search.model, start, goal));
  const auto found = search_chains(search, from, goals, bound, limits, work);
  if (found) best.offer(moves_of(search, from, found->chain));
  const double worth = kWorthTolerance * best.cost();
  // With a margin, where no way to the goal itself is found: little of the box would end
  // within the tolerances.
  if ((search.may_end_beside || !best.any()) && worth > bound) {
    if (auto near = search_within_tolerance(search, from, goal, worth, limits, work)) {
      best.offer(std::move(*near), kWorthTolerance);
    }
  }
  // What points push in pieces, the polish may make cheaper than any winding push.
  const bool is_dear = best.cost() > kWorthWinding * bound && !has_points(search);
  const bool may_wind = !best.any() || is_dear;
  if (may_wind && !limits.improves() && !limits.reached()) {
    auto wound = search_wound(search, from, goal, goals, bound, limits, work);
    if (wound && !best.any()) return wound;
    if (wound) best.offer(std::move(*wound), kWorthTolerance);
  }
  const double cost_of_first = direct ? cost_of(search, {*direct}) : best.cost();
  const GoalPlaces beside = tolerated_places(*search.model, goal, from);
  const auto is_open = [&] {
    return search.looks_for_cheaper && best.any() && best.cost() > kGoodEnough * bound;
  };
  if (is_open()) cheaper_with_real_pads(from, goals, beside, limits, work, best);
  if (is_open() && limits.improves()) {
    cheaper_by_one_contact(from, goals, beside, limits, work, best);
  }
  if (best.cost() < cost_of_first) ++work.found_cheaper;
  const double enough = limits.improves() ? kGoodEnough * bound : kDearPair;
  if (best.cost() <= enough || (direct && !limits.improves())) return best.take();
  auto longer = longer_moves(search, from, goals, &beside, found, lattices, limits, work);
  if (longer) best.offer(std::move(*longer));
  return best.take();
}

std::optional<std::vector<Move>> search_beside_goal(const SearchModel& search,
                                                    const Grasp& start, const Goal& goal,
                                                    WalkLattices& lattices,
                                                    const Limits& limits, Work& work) {
  const FlatState from = flat_state(start);
  const GoalPlaces places = tolerated_places(*search.model, goal, from);
  if (places.count == 0) return std::nullopt;
  const double bound = guide_bound(*search.model, start, goal);
  const auto found = search_chains(search, from, places, bound, limits, work);
  return longer_moves(search, from, places, nullptr, found, lattices, limits, work);
}

}  // namespace prehensile
