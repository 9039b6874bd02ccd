/// The exact planar instant over discretised pads, point and line pushers.
///
/// Solver: proximal semismooth Newton in the object twist, with the
/// enumeration of pusher modes (each a convex problem) as fallback and as verdict on
/// uniqueness where the fingers alone do not hold gravity.
#pragma once

#include "mechanics/instant.h"

namespace prehensile {

struct PlanarSolveOptions {
  double tolerance = 1e-9;          ///< natural-map residual in (F0, V0); 1e-12..1e-6
  int max_iterations = 400;         ///< Newton steps in all; raise for very stiff data
  bool probe_multiplicity = false;  ///< enumerate all pusher modes even if one was found
};

/// Warm start of a sequence of similar instants.
struct PlanarWarmStart {
  bool valid = false;
  PlanarInstant last;
};

/// Solves one instant. No heap, no exceptions. `warm` is read if valid, and written.
/// Gravity not held, no answer, bad numbers: see InstantStatus.
PlanarInstant solve_planar(const PlanarGrasp& grasp, const PlanarDrive& drive,
                           const PlanarSolveOptions& options = {},
                           PlanarWarmStart* warm = nullptr) noexcept;

}  // namespace prehensile
