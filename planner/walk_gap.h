/// How far the walks from a start are from a goal. Internal to the own planner.
#pragma once

#include "planner/limits.h"
#include "planner/walk_lattice.h"

namespace prehensile {

/// The least distance between places that walks from the start come to and places from
/// which walks lead to a goal, in spacings of the lattice; 0 where a walk leads there.
/// Where it is large no finer lattice closes it. Infinite if a limit is reached before it
/// is known.
double walk_gap(WalkLattice& lattice, const Limits& limits, Work& work);

}  // namespace prehensile
