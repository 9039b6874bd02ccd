/// The shortest plan of a single placement, as a chain of straight pushes by one contact.
/// Internal to the planner.
#pragma once

#include "planner/chains/chain_search.h"

namespace prehensile {

/// Solves the convex program of run_bound.h for each contact, goal place and angle that
/// may beat `to_beat`, and follows the way-points with as few pushes as lose little:
/// turning as rings do, or else as the pads' points do at every angle. Ends off the goal,
/// within its tolerances, have to be worth it (kWorthTolerance).
std::optional<Chain> search_runs(const SearchModel& search, const FlatState& start,
                                 const Goal& goal, double to_beat, const Limits& limits,
                                 Work& work);

/// Replaces a plan over round pads that may be far from optimal by one of a single
/// placement, if there is one that is cheaper; whether it did. Where the face clips discs
/// without a margin only: the program takes them for whole ones, and the pushes that
/// follow its way-points have to stick with what is left of them. Pushes by a point count
/// as one placement here, as in the search; the polish may make them one.
bool improve_by_run(const SearchModel& search, const Limits& limits, Work& work,
                    Plan& plan);

}  // namespace prehensile
