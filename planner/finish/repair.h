/// Repairs a plan that its exact check rejects, by moving its way-points.
#pragma once

#include "planner/steering/limits.h"

namespace prehensile {

/// Searches count the drift of tilted pushes along straight ways, and steer with a closed
/// form; the exact check counts the whole way, with the pads themselves. Where a push
/// slips by that, this moves the way-points of the plan, places and angles alike (NLopt,
/// sub-plex), until the exact check's slack of every push is 0 or more: what is missing
/// of a little more than that, squared and summed, is minimised. The sequence of contacts
/// stays, and pushes by points are left alone. False, and the plan stays, if no such
/// way-points are found, or NLopt is not built; what is found has to pass the exact
/// check. Deterministic.
bool repair(const SearchModel& search, const Limits& limits, Work& work, Plan& plan);

}  // namespace prehensile
