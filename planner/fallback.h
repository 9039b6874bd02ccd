/// What goes on where the exact stages find nothing. Internal to the planner.
#pragma once

#include <optional>

#include "planner/catalogue.h"
#include "planner/limits.h"

namespace prehensile {

/// The planner that carries on: of all baselines the one that finds most
/// (docs/benchmarks.md), in builds without OMPL, and for objects that can roll, of ours.
const char* fallback_planner(const Model& model);

/// Moves in the pad plane found by the fallback with `budget` units of work, shortened.
/// `goal` fixes no roll angle. The same for the same seed and budget.
std::optional<std::vector<Move>> fall_back(const SearchModel& search, const Grasp& start,
                                           const Goal& goal, const PlanOptions& options,
                                           std::int64_t budget, Work& work);

}  // namespace prehensile
