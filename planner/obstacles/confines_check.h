/// Whether the pushes of a plan keep to what confines them, looked at anew: by the poses
/// of the hand along each push, knowing nothing of the search.
#pragma once

#include <string>
#include <vector>

#include "planner/obstacles/hand_pose.h"
#include "planner/plan.h"

namespace prehensile {

/// What a replayed pose may be beyond a limit [m] and [rad].
inline constexpr double kLimitTolerance = 1e-6;

/// What a clearance may be short of the one that the scene asks for [m].
inline constexpr double kClearanceTolerance = 2e-5;

/// Which push first leaves the limits of the scene, or comes too near to an obstacle, or
/// brings the object too near to the hand's own bodies (`palm_bodies`), and how; empty if
/// none does. The hand's limits hold, and hand and object are clear, while they approach
/// and retreat, too. A distance is that of a plane found between two bodies
/// (separation.h), and no point of a way is left out: each distance clears the poses
/// after it up to where the fastest point might touch.
std::string confinement_fault(const Model& model, const std::vector<PlannedPush>& pushes);

/// Whether the hand is within its limits all along a straight way.
bool hand_stays_within(const GraspLimits& limits, const HandPose& from,
                       const HandPose& to);

/// Whether on a straight way hand and object keep clear of the fixture, by separating
/// planes as above, the hand stays within its limits, and the pads alone hold the object
/// in every attitude: looked at every hundredth of a radian, with room for how much
/// gravity can change in between.
bool transit_is_clear(const Model& model, const HeldObject& held, const HandPose& from,
                      const HandPose& to);

}  // namespace prehensile
