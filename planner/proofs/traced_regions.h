/// Regions beside lines that follow what sticks, which the finder of barriers tries.
/// Internal to the planner.
///
/// Where all free directions at a place lie within less than half a turn, a line through
/// it along one of those that are left and right of none of them cannot be crossed there
/// towards its left. The border of all places that can be reached consists of such lines.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "mechanics/model.h"
#include "planner/geometry/free_directions.h"
#include "planner/geometry/level_set.h"

namespace prehensile {

/// Some places of a goal set: without tolerances, and on the border of what these leave.
struct GoalSample {
  std::vector<Vec2> middle, border;  // not empty
};

/// Regions that hold the start and no place of the goal, at most `count`, on the right of
/// lines from near the start, near the goal and between them that end beside the object.
/// `stopped` is asked for each line.
std::vector<Loops> traced_regions(const Model& model, const GoalSample& goal,
                                  const FreeAt& free_at, int count,
                                  const std::function<bool()>& stopped = {});

inline constexpr double kEverywhere = std::numeric_limits<double>::infinity();

/// The region that ways from `apex` on reach: between the lines that follow the outermost
/// free directions to either side, turned `aside` by a share (0..0.5) of what they may
/// be; by more beyond a length of `closely` [m]. None if one of them ends on the object.
Loops region_ahead(const Model& model, const Vec2& apex, const FreeAt& free_at,
                   double aside, double closely = kEverywhere);

/// All but the region from which ways reach `apex`, likewise.
Loops region_not_behind(const Model& model, const Vec2& apex, const FreeAt& free_at,
                        double aside, double closely = kEverywhere);

}  // namespace prehensile
