/// The loop of short pushes that turns the object most for what it costs. Internal to the
/// own planner.
#pragma once

#include <optional>
#include <vector>

#include "planner/steering/limits.h"
#include "planner/walks/walk_ways.h"

namespace prehensile {

/// Pushes that lead back to where they began, by the contact that came there.
struct TurningLoop {
  std::vector<WalkStep> steps;
  std::vector<int> states;  ///< before each step
  double turn = 0.0;        ///< c dtheta that it can produce, to the side asked for [m]
};

/// Of all loops of edges on ways from the start to the goals, by Howard's algorithm:
/// policy iteration for the greatest ratio of turn to cost (Dasdan, "Experimental
/// analysis of the fastest optimum cycle ratio and mean algorithms", TODAES 2004).
/// `side`: 1 turns in the positive sense, -1 in the other. None if no loop turns the
/// object to that side, or a limit is reached.
std::optional<TurningLoop> turning_loop(WalkLattice& lattice, const WalkStates& states,
                                        const LeastRest& rest, int side,
                                        const Limits& limits, Work& work);

}  // namespace prehensile
