/// Cheaper pushes in the stead of dear ones. Internal to the own planner.
///
/// The first plan that a long search meets may place the pusher hundreds of times where
/// five times would do, or wind the hand up and back. What these functions are given they
/// leave as it is unless they find something cheaper, which some look for only if it is
/// dear; their answers have the same start, end in one of the goals, and cost no more.
/// Every push sticks with the real pad over the margin box. Each takes at most a part of
/// what is left of the work budget.
#pragma once

#include <vector>

#include "planner/chains/best_moves.h"
#include "planner/steering/goal.h"
#include "planner/steering/limits.h"

namespace prehensile {

class WalkLattices;

/// J from which a plan is dear: a cheaper one is looked for without being asked for.
/// Below it that seldom saves much, and takes tenths of a second.
inline constexpr double kDear = 15.0;

/// The same of two pushes: these then wind the hand up, and more pushes may do it for
/// less.
inline constexpr double kDearPair = 8.0;

/// Two pushes through a node of a lattice take the place of many.
std::vector<Move> cheaper_by_pairs(const SearchModel& search, std::vector<Move> moves,
                                   const Limits& limits, Work& work);

/// Two pushes with what the pads themselves allow at every angle, to the goals and,
/// without a margin and where that is worth it, beside them: over the ellipsoid some are
/// hidden that are cheaper, as where gravity lets one contact carry the object aside
/// while it turns. Not over soft points, whose friction the ellipsoid is.
void cheaper_with_real_pads(const FlatState& start, const GoalPlaces& goals,
                            const GoalPlaces& beside, const Limits& limits, Work& work,
                            BestMoves& best);

/// Walks by a single contact, each in turn, to the same places: they take tenths of a
/// second each.
void cheaper_by_one_contact(const FlatState& start, const GoalPlaces& goals,
                            const GoalPlaces& beside, const Limits& limits, Work& work,
                            BestMoves& best);

/// J from which a walk is looked for in the stead of few pushes, which takes a second.
inline constexpr double kWorthWalk = 20.0;

/// A walk over a fine lattice takes the place of all, if they cost J = `worth` and more.
std::vector<Move> cheaper_by_walk(const SearchModel& search, const FlatState& start,
                                  const GoalPlaces& goals, std::vector<Move> moves,
                                  double worth, WalkLattices& lattices,
                                  const Limits& limits, Work& work);

}  // namespace prehensile
