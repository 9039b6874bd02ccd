/// What a walk has still to cost. Internal to the own planner.
#pragma once

#include "planner/chains/least_rest.h"
#include "planner/steering/limits.h"
#include "planner/walks/walk_lattice.h"

namespace prehensile {

/// From each node of a lattice to a place of the goal: the walks that a search need not
/// look at are those from which no way leads there, or a dear one only. Of the edges that
/// the lattice has now: it stays a bound when some are cut.
///
/// Asks the lattice for the edges of every node that a way from the start leads to.
/// Infinite everywhere if a limit is reached before.
LeastRest rest_of_walks(WalkLattice& lattice, int contacts, const Limits& limits,
                        Work& work);

}  // namespace prehensile
