/// Random planar instants for tests and benchmarks: boxes between rectangular pads,
/// pushed on a face by a point or a line. Deterministic: (seed, index) names an instant.
#pragma once

#include <cstdint>

#include "mechanics/planar_problem.h"

namespace prehensile {

/// What is drawn. Always: box half-sides 15-75 mm, mass 0.02-1 kg and grip force 5-100 N
/// (log-uniform), finger friction 0.2-1, pusher friction 0.1-0.9, pads of half-sides 3-12
/// mm turned at random, centre of mass up to a fifth of the box off its middle, pads
/// anywhere on the box, gravity in any direction of the plane, push within 60 degrees of
/// the normal of one of four faces at 10 mm/s.
struct InstantRange {
  int points_per_pad = 16;  ///< 1, 2, 4, 8, 16, 32 or 64 (Gauss products)
  int pusher_points = 0;    ///< 1, 2, or 0: either
  double turning_share =
      0.25;              ///< share of pushers that also turn, by up to 1 rad / 50 mm
  double inertia = 0.0;  ///< rates become accelerations of this size [m/s^2]; 0: none
};

struct RandomInstant {
  PlanarGrasp grasp;
  PlanarDrive drive;
};

/// The instant of this seed and index. The same box, loads and pusher for every
/// `points_per_pad`, so that pads may be compared.
RandomInstant random_instant(std::uint64_t seed, std::uint64_t index,
                             const InstantRange& range = {});

}  // namespace prehensile
