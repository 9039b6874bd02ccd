#include "planner/search/wound_search.h"

#include "planner/chains/chain_search.h"
#include "planner/chains/direct_push.h"
#include "planner/chains/shorten.h"
#include "planner/search/cheapen.h"

namespace prehensile {
namespace {

/// What winds the object up for less is taken as it is; for more, three and more pushes
/// are looked for with so much work first.
constexpr double kCheap = 3.0;
constexpr std::int64_t kWorkOnMorePushes = 50'000;

/// What a few places along a push say of pads that change with the angle is nothing where
/// the object turns many times.
bool are_alike_at_every_angle(const SearchModel& search) {
  return search.exact_everywhere || search.model->region.is_isotropic();
}

/// One push to a place off the goal by up to its tolerances.
std::optional<Move> push_beside(const SearchModel& search, const FlatState& from,
                                const Goal& goal, Work& work) {
  for (int share = 0; share < kWoundShares; ++share) {
    const GoalPlaces beside = wound_tolerated_places(*search.model, goal, from, share);
    if (const auto move = direct_push(search, from, beside, work)) return move;
  }
  return std::nullopt;
}

std::optional<std::vector<Move>> one_or_two(const SearchModel& search,
                                            const FlatState& from, const Goal& goal,
                                            double bound, const Limits& limits,
                                            Work& work) {
  if (!are_alike_at_every_angle(search)) return std::nullopt;
  const GoalPlaces wound = wound_places(*search.model, goal, from);
  if (const auto move = direct_push(search, from, wound, work)) {
    return std::vector{*move};
  }
  if (!search.exact_everywhere) return std::nullopt;
  if (const auto found = search_chains(search, from, wound, bound, limits, work)) {
    return moves_of(search, from, found->chain);
  }
  if (const auto move = push_beside(search, from, goal, work)) return std::vector{*move};
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Move>> search_wound(const SearchModel& search,
                                              const FlatState& from, const Goal& goal,
                                              const GoalPlaces& goals, double bound,
                                              const Limits& limits, Work& work) {
  auto moves = one_or_two(search, from, goal, bound, limits, work);
  if (!moves) return std::nullopt;
  const double cost = cost_of(search, *moves);
  if (cost >= kDearPair) return std::nullopt;
  if (cost < kCheap) return moves;
  const auto more = within_budget(work, kWorkOnMorePushes, [&] {
    return search_exact_chains(search, from, goals, limits, work);
  });
  if (more && more->chain.cost < cost) return moves_of(search, from, more->chain);
  return moves;
}

}  // namespace prehensile
