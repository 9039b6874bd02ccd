/// Straight lines from the reflex corners of the object that a contact alone does not
/// cross. Internal to the planner.
#pragma once

#include <span>
#include <vector>

#include "planner/bounds/run_bound.h"
#include "planner/pads/local_law.h"

namespace prehensile {

/// Whether some line from a reflex corner to the border keeps the finger axis on the side
/// of its start, away from all goals, while only this contact pushes, however often the
/// object turns: no motion across it is one that the contact may make (local_law.h). Into
/// the stem of a T, say, ways round a corner lead where one pusher does not. A
/// millisecond. Allocates.
bool is_barred(const LocalLaw& law, int contact, const std::vector<Vec2>& outline,
               const Vec2& start, std::span<const GoalArc> goals);

}  // namespace prehensile
