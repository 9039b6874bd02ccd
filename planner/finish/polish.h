/// Shortens a plan by moving its way-points.
#pragma once

#include "planner/steering/limits.h"

namespace prehensile {

/// Minimises J over the way-points of the plan (NLopt, sub-plex), the rotations being
/// eliminated exactly at each trial (chain.h); the sequence of contacts stays, a push
/// that has become superfluous is dropped, and pushes are cut in two, by the same
/// contact, where that shortens the plan by 2 %. The plan stays as it is where that
/// brings nothing, or leaves the margin with the real pad, or NLopt is not built.
/// Deterministic.
void polish(const SearchModel& search, const Limits& limits, Work& work, Plan& plan);

/// The same with rotations that the pads themselves allow at every angle instead of the
/// closed form's, for two to three times the work. Not of cans, nor over soft points,
/// whose friction the closed form knows.
void polish_with_real_pads(const SearchModel& search, const Limits& limits, Work& work,
                           Plan& plan);

}  // namespace prehensile
