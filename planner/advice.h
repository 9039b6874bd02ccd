/// Why a search found no plan, and which change of the scene would let it: every change
/// that is named has been planned for and worked.
#pragma once

#include "planner/planner.h"

namespace prehensile {

/// What stopped the search most, in one paragraph, and the smallest change of each kind
/// that makes the scene solvable with the margin asked for: of the frictions of pushers
/// and fingers, of the grip force, of the goal's tolerances, of its angle, of limits and
/// obstacles, one pusher more. `options` are those of the plan; `budget` counts the stick
/// tests of each trial, which is by the own planner. Deterministic; ends early when
/// options.stop is set or their time limit is over, counted from when `plan` was begun,
/// with the changes found until then. For plans that are not usable, or have less than
/// that margin. The options that are named are those of the command `plan`, tried with
/// the values that they name.
Explanation explain(const Model& model, const Plan& plan, const PlanOptions& options,
                    std::int64_t budget = 300'000);

}  // namespace prehensile
