#include "planner/search/fallback.h"

#include <algorithm>

#include "planner/baselines/baselines.h"
#include "planner/chains/shorten.h"

namespace prehensile {
namespace {

/// A first plan of random trees is mostly a long one: others are looked for with this
/// many times its work, and the cheapest is kept.
constexpr std::int64_t kWorkOnOthers = 4;

std::optional<std::vector<Move>> found_by_trees(const SearchModel& search,
                                                const Grasp& start, const Goal& goal,
                                                const PlanOptions& options,
                                                std::uint64_t seed, Work& work) {
  const PlannerSettings defaults;
  const BaselineQuestion question{search,   start, goal, *find_planner(kFallbackPlanner),
                                  defaults, seed};
  const Limits limits(options, work);
  const auto moves = grow_two_trees(question, limits, work);
  if (!moves) return std::nullopt;
  return shortened(search, joined_moves(search, *moves), limits, work);
}

}  // namespace

std::optional<std::vector<Move>> fall_back(const SearchModel& search, const Grasp& start,
                                           const Goal& goal, const PlanOptions& options,
                                           std::int64_t budget, Work& work) {
  const std::int64_t whole = work.budget;
  const std::int64_t before = work.done();
  work.budget = std::min(whole, before + budget);
  std::uint64_t seed = options.seed;
  auto best = found_by_trees(search, start, goal, options, seed, work);
  if (best) {
    const std::int64_t first = work.done() - before;
    work.budget = std::min(work.budget, work.done() + kWorkOnOthers * first);
    while (!work.spent()) {
      const auto other = found_by_trees(search, start, goal, options, ++seed, work);
      if (!other) break;
      if (cost_of(search, *other) < cost_of(search, *best)) best = other;
    }
  }
  work.budget = whole;
  return best;
}

}  // namespace prehensile
