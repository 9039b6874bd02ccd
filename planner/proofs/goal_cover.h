/// A goal set covered by a grid over its angles, for proofs about all of its members.
/// Internal to the planner.
#pragma once

#include <algorithm>
#include <numbers>

#include "scene/scene.h"

namespace prehensile {

/// [rad] by which the angle may differ from that of the goal.
inline double angle_tolerance(const Goal& goal) {
  return goal.test == GoalTest::kPerCoordinate
             ? goal.angle_tolerance
             : goal.position_tolerance / goal.characteristic_length;
}

/// Greatest distance of a member of the goal set from a place with the fixed coordinates.
inline double place_tolerance(const Goal& goal) {
  const bool both = goal.x && goal.y && goal.test == GoalTest::kPerCoordinate;
  return goal.position_tolerance * (both ? std::numbers::sqrt2 : 1.0);
}

/// True if `holds(theta, half_step)` is true on a grid over every angle of O in H that
/// the goal set contains; half_step [rad] is how far an angle may be from the grid.
template <class Test>
bool for_all_goal_angles(const Goal& goal, const Test& holds) {
  const double middle = goal.theta.value_or(0.0);
  const double half_range =
      goal.theta ? std::min(angle_tolerance(goal), std::numbers::pi) : std::numbers::pi;
  const int steps = 16 + static_cast<int>(3000.0 * half_range);
  const double half_step = half_range / steps;
  for (int i = 0; i <= steps; ++i) {
    if (!holds(middle + half_range * (2.0 * i / steps - 1.0), half_step)) return false;
  }
  return true;
}

/// Where the finger axis is in O at an angle of O in H, of a goal that fixes x and y,
/// before tolerances [m].
inline Vec2 goal_place(const Goal& goal, double theta) {
  return -rotated(-theta, {*goal.x, *goal.y});
}

/// The same of every place p_OF [m] of a goal that fixes x and y: `holds(p_OF, radius)`,
/// radius [m] being how far a place of the goal set may be from those looked at.
template <class Test>
bool for_all_goal_places(const Goal& goal, const Test& holds) {
  const Vec2 position{*goal.x, *goal.y};
  return for_all_goal_angles(goal, [&](double theta, double half_step) {
    return holds(goal_place(goal, theta),
                 place_tolerance(goal) + half_step * position.norm() + 1e-9);
  });
}

}  // namespace prehensile
