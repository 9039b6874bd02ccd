/// Places along its face where a pusher leaves the hand clear of obstacles. Internal to
/// the planner.
#pragma once

#include "planner/steering.h"

namespace prehensile {

/// Where no contact of a search among obstacles is clear with the hand at the start, or
/// at any place of the goal: adds the places of its line pushers, looked at every
/// millimetre, at which it is, the middle of each stretch of them. A few at most.
void add_clear_places(const Model& model, SearchModel& search);

}  // namespace prehensile
