/// The paper's own formulation, for comparison: complementarity products summed as the
/// objective, linear constraints, polyhedral friction cones with g generators, minimised
/// by an interior-point method (paper section VI-B). Residual-gated: the library's
/// verdict is never believed.
#pragma once

#include "mechanics/instant.h"

namespace prehensile {

struct ReferenceOptions {
  int generators = 8;        ///< g of paper eq. (2): even, 4..64
  int starts = 3;            ///< starting points tried until the residual gate is passed
  int max_iterations = 300;  ///< per start
  double gate = 1e-4;        ///< largest accepted complementarity residual in (F0, V0)
};

/// Answers the same planar question as solve_planar, but on polyhedral cones with g
/// generators per finger point, which lie inside the circular ones: the push force of a
/// frictionless pusher is short by O(1/g^2), twists are off by about O(1/g).
///
/// What the minimiser leaves is sharpened by a linear solve with the pattern it found, so
/// `residual` (of the polyhedral laws, largest over all complementarity pairs and eq.
/// (8)) is usually at rounding; it is stated as it is, up to the gate. `finger` forces
/// obey the polyhedral law, and a line that sticks shares its tangential force in
/// proportion to the normal forces.
///
/// kMoves, kHolds, kSeparated: an answer; whether it is the only one is not examined.
/// kOutOfIterations: no start passed the gate, be it that there is no answer (the grasp
/// does not hold gravity) or that it was not found. kBadInput: as solve_planar, and for
/// `generators` out of range. kNotRun: built without the library. Not for hot paths:
/// milliseconds, heap.
PlanarInstant solve_reference(const PlanarGrasp& grasp, const PlanarDrive& drive,
                              const ReferenceOptions& options = {});

bool reference_is_built();

}  // namespace prehensile
