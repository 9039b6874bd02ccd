/// The exact planar instant over discretised pads, point and line pushers.
///
/// In the quasi-static limit the answer is one of a few pusher modes (stick, slip, one
/// end or both), each a convex or scalar problem over the friction of the pads. Where the
/// pads alone hold gravity there is one motion, and the first mode that obeys all laws is
/// the answer. Where they do not, all modes are tried: none can balance (kDynamic), or
/// some do (kAmbiguous: the pusher carries the object). With inertia, a proximal
/// semismooth Newton method in the object twist. Every answer obeys all laws to
/// `residual`, or says that it does not.
#pragma once

#include "mechanics/instant.h"

namespace prehensile {

struct PlanarSolveOptions {
  /// Natural-map residual that Newton's method must reach, in units of pad capacity, pad
  /// lever and push rate; 1e-12..1e-6. Modes are solved to rounding.
  double tolerance = 1e-9;
  int max_iterations = 400;         ///< Newton steps in all; raise for very stiff data
  bool probe_multiplicity = false;  ///< enumerate all pusher modes even if one was found
};

/// Warm start of a sequence of similar instants.
struct PlanarWarmStart {
  bool valid = false;
  PlanarInstant last;
};

/// Solves one instant. No heap, no exceptions. `warm` is read if valid, and written.
///
/// kSeparated or kHolds where the pusher approaches at no point and the pads hold gravity
/// (friction may drag the object along as well: probe_multiplicity tells). kBadInput for
/// no points, bounds all zero or negative, a pusher at rest, numbers that are not finite
/// (or whose squares in units of the pads are not).
/// kJammed does not occur: pads and one flat pusher cannot wedge an object. The
/// tangential force of a sticking line is determined only as a sum, and shared in
/// proportion to the normal forces. `iterations` counts the Newton steps of the mode that
/// answered.
PlanarInstant solve_planar(const PlanarGrasp& grasp, const PlanarDrive& drive,
                           const PlanarSolveOptions& options = {},
                           PlanarWarmStart* warm = nullptr) noexcept;

}  // namespace prehensile
