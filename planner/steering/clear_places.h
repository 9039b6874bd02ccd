/// Places along its face where a pusher leaves the hand clear of obstacles. Internal to
/// the planner.
#pragma once

#include "planner/steering/steering.h"

namespace prehensile {

/// Among obstacles, for the start, and then for the goal (its nearest places where it
/// leaves some free): if with no contact of the search the hand is clear there, adds the
/// places of its line pushers at which it is, looked at every millimetre along the face:
/// the middles of up to three stretches of each. Nothing where the scene names no
/// obstacles.
void add_clear_places(const Model& model, SearchModel& search);

}  // namespace prehensile
