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

/// Answers the same planar question as solve_planar, but on the polyhedral cone, so it
/// carries an error of O(1/g^2). kOutOfIterations if no start passes the gate, kNotRun if
/// the library was not built. Not for hot paths: milliseconds, heap.
PlanarInstant solve_reference(const PlanarGrasp& grasp, const PlanarDrive& drive,
                              const ReferenceOptions& options = {});

bool reference_is_built();

}  // namespace prehensile
