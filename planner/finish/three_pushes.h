/// Up to three pushes by one contact, by what the real pads allow. Internal to the
/// planner.
///
/// What seems to need two placements one contact often does in three directions. Those
/// are looked for among what sticks at some place along the way (fan.h): the shortest
/// combination that makes the whole way at once, in the order in which each of its pushes
/// sticks.
#pragma once

#include "planner/steering/limits.h"

namespace prehensile {

/// Replaces a plan that may be far from optimal by up to three pushes of a line, if some
/// cost less: to the goal, or without a margin also beside it, within its tolerances,
/// where that saves a tenth. Whether it did. Not of cans.
bool improve_by_three_pushes(const SearchModel& search, const Limits& limits, Work& work,
                             Plan& plan);

}  // namespace prehensile
