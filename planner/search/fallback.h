/// What goes on where the exact stages find nothing. Internal to the planner.
#pragma once

#include <optional>
#include <vector>

#include "planner/planner.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// The planner that carries on: of all baselines, OMPL's included, the one that solves
/// most of what the exact stages leave open (docs/planners.md).
inline constexpr const char* kFallbackPlanner = "two-trees";

/// Moves in the pad plane found by the fallback with `budget` units of work: the cheapest
/// of the plans that it finds in a few times the work of the first, joined and shortened
/// by the means of the exact stages. `goal` fixes no roll angle. The same for the same
/// seed and budget.
std::optional<std::vector<Move>> fall_back(const SearchModel& search, const Grasp& start,
                                           const Goal& goal, const PlanOptions& options,
                                           std::int64_t budget, Work& work);

}  // namespace prehensile
