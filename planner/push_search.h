/// Our own push planner: exact stages from the closed-form direct push to a search over a
/// lattice. Knows nothing of OMPL.
///
/// Source: the exact steering of this library over the flat space (p_OF, c theta);
/// compare the motion-cone planners of Chavan-Dafle, Holladay and Rodriguez (2018, 2020).
#pragma once

#include "planner/chain.h"
#include "planner/frame.h"
#include "planner/goal.h"
#include "planner/limits.h"

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

/// Ends a search in the pad plane: adds the roll that the goal wants and sets the status,
/// with the limit that ended it where it found nothing.
void conclude_search(const SearchModel& search, const Goal& goal,
                     const PlanOptions& options, bool found, const Limits& limits,
                     Plan& plan);

/// A plan without pushes for this question: names, margin, seed, start.
Plan blank_plan(const SearchModel& search, const Grasp& start,
                const PlanOptions& options);

/// Appends the push of a move, from where the plan has come.
void append_move(const SearchModel& search, const Move& move, Plan& plan);

/// Appends the pushes of a solved chain.
void append_chain(const SearchModel& search, const FlatState& start, const Chain& chain,
                  Plan& plan);

}  // namespace prehensile
