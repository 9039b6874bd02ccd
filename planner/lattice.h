/// Way-points on a lattice over the object: the search of last resort of our planner.
#pragma once

#include <vector>

#include "planner/way_points.h"

namespace prehensile {

/// Places of the finger axis on the object where gravity is held during some contact:
/// a square lattice of about `wanted` nodes, then the extra places.
std::vector<Vec2> lattice_nodes(const SearchModel& search, int wanted);

/// Adds every node as single way-point for every pair of contacts and every goal place.
void add_nodes(const SearchModel& search, const std::vector<Vec2>& nodes,
               const FlatState& start, const GoalPlaces& goals, Work& work,
               BestWayPoints& best);

}  // namespace prehensile
