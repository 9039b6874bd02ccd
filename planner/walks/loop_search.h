/// Walks that go around one loop as often as it takes. Internal to the own planner.
///
/// What pushes allow at a place is the same whatever the object has turned by so far, but
/// for limits. So where a loop of pushes turns the object, however little, n times around
/// turn it n times as much, and a goal whose place is reached is reached at any angle.
/// search_walks tells apart what walks turn by, and keeps no loop that turns less than it
/// tells apart; here nothing is told apart: a walk is the cheapest way to a loop, the
/// loop that turns most for its cost, and the cheapest way on.
#pragma once

#include <optional>
#include <vector>

#include "planner/steering/goal.h"
#include "planner/steering/limits.h"
#include "planner/walks/walk_lattice.h"

namespace prehensile {

/// Pushes to one of the goals, or where there are none to one of those beside them,
/// shortened; each sticks with the real pads. For the same scenes as search_walks, over
/// lattices of the same and, of the usual steepness, others of more ways.
std::optional<std::vector<Move>> search_loops(const SearchModel& search,
                                              const FlatState& start,
                                              const GoalPlaces& goals,
                                              const GoalPlaces& beside,
                                              Steepness steepness, WalkLattices& kept,
                                              const Limits& limits, Work& work);

}  // namespace prehensile
