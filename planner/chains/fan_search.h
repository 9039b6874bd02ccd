/// Plans of many short pushes along a path, where the exact stages find nothing: complete
/// in the limit wherever the object is locally controllable, and beyond.
///
/// The straight way to the goal in the flat space (p_OF, c theta), bent only to stay on
/// the object, is cut into pieces; each is made of up to three moves of the fan at its
/// start. Shorter pieces follow until the moves stick: all of them, with the real pad.
///
/// A goal where the object is not controllable may still be reached: along a leg into it
/// on which the rotation is left to itself. What the leg turns is then turned back before
/// it, where the object can be turned. The same holds for starts, backwards.
#pragma once

#include <optional>
#include <vector>

#include "mechanics/pad_envelope.h"
#include "planner/steering/goal.h"
#include "planner/steering/limits.h"

namespace prehensile {

/// Moves from the start to a member of the goal set, shortened; none if every fineness
/// fails or a limit is reached before.
std::optional<std::vector<Move>> search_fan(const SearchModel& search,
                                            const PadEnvelope& envelope,
                                            const FlatState& start,
                                            const GoalPlaces& goals, const Limits& limits,
                                            Work& work);

}  // namespace prehensile
