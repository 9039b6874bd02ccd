/// Our own push planner: exact stages from the closed-form direct push to a search over a
/// lattice. Knows nothing of OMPL.
///
/// Source: the exact steering of this library over the flat space (p_OF, c theta);
/// compare the motion-cone planners of Chavan-Dafle, Holladay and Rodriguez (2018, 2020).
#pragma once

#include "planner/planner.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// Plans from `start` to `goal`, in order of effort: one push; two pushes through a
/// crossing of cone lines; two pushes through a lattice node; a best-first search over
/// the lattice; many short pushes along a path (fan_search.h) or over a fine lattice
/// (walk_search.h); with the share of the budget that its option `fallback_share` says, a
/// baseline (fallback.h), whose plan is shortened by the same means; and the stages from
/// the crossing on to places off the goal within its tolerances. Every push of the answer
/// sticks with the real pad over the margin box of `search`.
///
/// Status: kReachedGoal (pushes with start and end poses; forces and certificates still
/// unset), kBudgetSpent, kStopped, kUnsupported (a roll is wanted and none is possible).
Plan search_pushes(const SearchModel& search, const Grasp& start, const Goal& goal,
                   const PlanOptions& options, Work& work);

}  // namespace prehensile
