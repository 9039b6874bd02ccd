/// Way-points on a lattice over the object: the search of last resort of our planner.
#pragma once

#include <vector>

#include "planner/chains/way_points.h"

namespace prehensile {

/// Places of the finger axis on the object where gravity is held during some contact: a
/// square lattice of about `wanted` nodes over the object.
std::vector<Vec2> lattice_nodes(const SearchModel& search, int wanted);

/// Adds a lattice of `per_side` x `per_side` nodes around two places, as wide as twice
/// their distance, at least 2 cm: short regrasps need short pushes.
void add_local_nodes(const SearchModel& search, const Vec2& a, const Vec2& b,
                     int per_side, std::vector<Vec2>& nodes);

/// Adds every node as single way-point for every pair of contacts and every goal place,
/// but for those too far off for a plan that `best` would keep.
void add_nodes(const Steering& steering, const std::vector<Vec2>& nodes,
               const FlatState& start, const GoalPlaces& goals, Work& work,
               BestWayPoints& best);

}  // namespace prehensile
