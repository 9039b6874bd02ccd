/// Goals that are met only where the object winds up: by more whole turns than the stages
/// of few pushes look at. Internal to the own planner.
#pragma once

#include <optional>
#include <vector>

#include "planner/steering/goal.h"
#include "planner/steering/limits.h"

namespace prehensile {

/// Where those stages find nothing: one push to the goal by two to thirteen whole turns
/// more, or over pads that the search knows exactly two, or one to a place beside it that
/// its tolerances leave; or three and more to `goals` where a short search finds such and
/// they cost less. None that cost kDearPair (cheapen.h) and more, and none over pads that
/// are not round.
///
/// `bound`: as of search_chains.
std::optional<std::vector<Move>> search_wound(const SearchModel& search,
                                              const FlatState& from, const Goal& goal,
                                              const GoalPlaces& goals, double bound,
                                              const Limits& limits, Work& work);

}  // namespace prehensile
