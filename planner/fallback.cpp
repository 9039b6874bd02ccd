#include "planner/fallback.h"

#include <algorithm>

#include "planner/baselines.h"
#include "planner/shorten.h"

namespace prehensile {

std::optional<std::vector<Move>> fall_back(const SearchModel& search, const Grasp& start,
                                           const Goal& goal, const PlanOptions& options,
                                           std::int64_t budget, Work& work) {
  const PlannerSettings defaults;
  const BaselineQuestion question{
      search, start, goal, *find_planner(kFallbackPlanner), defaults, options.seed};
  const std::int64_t whole = work.budget;
  work.budget = std::min(whole, work.done() + budget);
  const auto moves = shoot_at_random(question, Limits(options, work), work);
  work.budget = whole;
  if (!moves) return std::nullopt;
  return shortened(search, joined_moves(search, *moves), Limits(options, work), work);
}

}  // namespace prehensile
