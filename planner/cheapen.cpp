#include "planner/cheapen.h"

#include <utility>

#include "planner/shorten.h"
#include "planner/walk_search.h"

namespace prehensile {
namespace {

/// Of what is left of the budget.
constexpr double kShareOfPairs = 0.6;
constexpr double kShareOfWalk = 0.3;

void enter(const char* stage, double cost, Work& work) {
  if (!work.meter) return;
  work.meter->enter(stage);
  work.meter->found(cost);
}

}  // namespace

std::vector<Move> cheaper_by_pairs(const SearchModel& search, std::vector<Move> moves,
                                   const Limits& limits, Work& work) {
  const double cost = cost_of(search, moves);
  if (cost < kDear) return moves;
  enter("cheaper pushes", cost, work);
  moves = within_budget(work, share_of_left(work, kShareOfPairs), [&] {
    return shortened_over_lattice(search, moves, limits, work);
  });
  if (work.meter) work.meter->found(cost_of(search, moves));
  return moves;
}

std::vector<Move> cheaper_by_walk(const SearchModel& search, const FlatState& start,
                                  const GoalPlaces& goals, std::vector<Move> moves,
                                  double worth, WalkLattices& lattices,
                                  const Limits& limits, Work& work) {
  const double cost = cost_of(search, moves);
  if (cost < worth) return moves;
  enter("cheaper walk", cost, work);
  auto walk = within_budget(work, share_of_left(work, kShareOfWalk), [&] {
    return search_walks(search, start, goals, cost, lattices, limits, work);
  });
  if (walk && cost_of(search, *walk) < cost) moves = std::move(*walk);
  if (work.meter) work.meter->found(cost_of(search, moves));
  return moves;
}

}  // namespace prehensile
