/// Moves a plan off the border of what its margin allows.
#pragma once

#include "planner/steering/limits.h"

namespace prehensile {

/// The cheapest plan with a margin mostly lies on the border of that margin: one of its
/// pushes slips in a scene that is off by a little more. This moves its way-points,
/// places and angles alike (NLopt, sub-plex), to where the exact check leaves each push
/// more slack and the pads more room, and lets the plan cost up to `share` more for that.
/// The sequence of contacts and the end stay; pushes by points are left alone. False, and
/// the plan stays, if that gains too little, or NLopt is not built; an eased plan has to
/// pass the exact check. Deterministic.
bool ease(const SearchModel& search, double share, const Limits& limits, Work& work,
          Plan& plan);

}  // namespace prehensile
