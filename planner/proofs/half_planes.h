/// Regions beside straight lines, which the finder of barriers tries. Internal to the
/// planner.
#pragma once

#include <vector>

#include "mechanics/model.h"
#include "planner/geometry/free_directions.h"
#include "planner/geometry/level_set.h"

namespace prehensile {

/// Regions of places that hold the start, and none of `goals`, up to a straight line that
/// hardly any of the free directions leads across, at most `count`: first the one from
/// which they keep farthest. A straight line shows what levels on a grid, whose borders
/// have many directions, do not: that all ways lead into one half-plane, by a little.
std::vector<Loops> half_planes(const Model& model, const std::vector<Vec2>& goals,
                               const FreeAt& free_at, int count);

}  // namespace prehensile
