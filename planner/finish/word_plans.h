/// Plans from the boxes of the branch and bound: what cannot be excluded is where a
/// cheaper plan would have to be. Internal to the planner.
#pragma once

#include "planner/steering/limits.h"

namespace prehensile {

/// Replaces a plan over pads that the search knows exactly and that is more than 10 %
/// above its trivial bound by a cheaper one, if the branch and bound that is asked to
/// prove its cost comes by one: the centres of the boxes that it divides are taken for
/// way-points, and the cheapest chains found are polished. False: the plan stays as it
/// is. Deterministic; `work` counts the boxes.
bool improve_by_words(const SearchModel& search, const Limits& limits, Work& work,
                      Plan& plan);

}  // namespace prehensile
