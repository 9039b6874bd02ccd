/// What a plan pays for, as a scene states it.
#pragma once

namespace prehensile {

/// Prices in placements of a pusher, which cost 1 each (planner/plan.h).
struct CostWeights {
  double travel = 1.0;       ///< of travel as long as the object's longer side, 0.01..100
  double work = 0.0;         ///< [1/J] of what the friction of the pads takes, 0..1e4
  double grip_change = 0.0;  ///< of each change of the grip force, 0..100

  friend bool operator==(const CostWeights&, const CostWeights&) = default;
};

}  // namespace prehensile
