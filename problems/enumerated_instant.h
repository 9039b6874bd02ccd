/// Planar instants once more, by a way that shares nothing with the solvers: every mode
/// of the pusher is a small system of equations, searched by scanning and by Newton's
/// method from many starts, and every solution that obeys all inequalities is a motion.
/// Slow; for tests and benchmarks.
///
/// Source: paper eq. (1), (3), (8); quasi-static, finger loads known.
#pragma once

#include <vector>

#include "problems/random_instants.h"

namespace prehensile {

struct EnumeratedMotion {
  PlanarTwist V_HO;     ///< [m/s, rad/s] in H
  PlanarWrench w_push;  ///< [N, N m] pusher on object, about the origin of H
};

/// All motions in which the pusher carries load, without repetition: twists that differ
/// by less than 1e-7 of the push rate are one. Requires bounds > 0 and a pusher that
/// moves. Motions in which a line's two ends stick while the object turns about a pad
/// point are left out (their forces are not unique).
std::vector<EnumeratedMotion> enumerate_motions(const RandomInstant& instant);

}  // namespace prehensile
