/// How far the walks from a start are from a goal. Internal to the own planner.
#pragma once

#include <optional>

#include "planner/steering/limits.h"
#include "planner/walks/walk_lattice.h"

namespace prehensile {

struct WalkGap {
  double spacings = 0.0;                        ///< of the lattice
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< [m] the places, in O
};

/// Between the nearest places of which walks from the start come to one and walks lead
/// from the other to a goal; of nought where a walk leads there. None if a limit is
/// reached before it is known.
std::optional<WalkGap> walk_gap(WalkLattice& lattice, const Limits& limits, Work& work);

}  // namespace prehensile
