/// Long walks of short pushes. Internal to the own planner.
///
/// Where the finger axis can be led around a loop and the object turns a little on each,
/// dozens of pushes may be needed; and where the face clips the pads, the pushes that
/// help are not those of the closed form. Both are known to this search: it goes from
/// node to node of a fine lattice of places by what sticks with the pads as they are
/// there (place_law.h), and carries intervals of the angle, up to 15 rad to either side,
/// as search_labels does.
#pragma once

#include <optional>
#include <vector>

#include "planner/steering/goal.h"
#include "planner/steering/limits.h"
#include "planner/walks/walk_lattice.h"

namespace prehensile {

/// False among obstacles, and for pads that need the mechanics in space.
bool is_for_walks(const SearchModel& search);

/// Pushes to one of the goals, shortened from the cheapest walk over the lattice; each
/// sticks with the real pads. A goal that is an angle is met at any whole turn. None if
/// they are not for such scenes, the lattice holds no walk cheaper than `to_beat`
/// (infinity: any) or a limit is reached. `lattices`: kept for other walks of the same
/// search.
std::optional<std::vector<Move>> search_walks(const SearchModel& search,
                                              const FlatState& start,
                                              const GoalPlaces& goals, double to_beat,
                                              WalkLattices& lattices,
                                              const Limits& limits, Work& work);

}  // namespace prehensile
