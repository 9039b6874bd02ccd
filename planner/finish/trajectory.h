/// Changes a plan as one trajectory, with all its way-points at once: repairs one that
/// its exact check rejects, shortens one that it accepts.
#pragma once

#include "planner/steering/limits.h"

namespace prehensile {

/// What repair() does, faster and for more pushes, by Ipopt: a direct transcription whose
/// unknowns are the way-points, places and angles alike, and the path travelled before
/// each push; whose constraints are the slacks that the exact check finds along each part
/// of each push, gravity held where pushes meet, and the room that the pads need on the
/// object. Way-points as near as possible to those of the plan are looked for; what a
/// push misses is priced, so that every start is a feasible one.
///
/// Contact forces and slip are no unknowns. A push of a plan sticks all along: of each
/// pair of slip and slack it is the slip that is zero, and a slack of 0 or more says that
/// there are forces that make the push (mechanics/sticking.h), in every member of the
/// margin box.
///
/// The sequence of contacts stays, and pushes by points are left alone. False, and the
/// plan stays, if no such way-points are found, or Ipopt is not built; what is found has
/// to pass the exact check. Deterministic.
bool repair_as_trajectory(const SearchModel& search, const Limits& limits, Work& work,
                          Plan& plan);

/// The same for a plan that sticks, with the path travelled in the stead of the distance
/// from its way-points, and nothing that a push may miss: what polish() does where it has
/// too many pushes for that, or where the closed form knows less than the exact check.
bool shorten_as_trajectory(const SearchModel& search, const Limits& limits, Work& work,
                           Plan& plan);

}  // namespace prehensile
