/// Random spatial instants for tests and benchmarks: boxes between rectangular pads,
/// pushed on a face by a point, a line or a plane. Deterministic: (seed, index) names an
/// instant.
#pragma once

#include <cstdint>

#include "mechanics/planar_problem.h"
#include "mechanics/spatial_problem.h"

namespace prehensile {

/// What is drawn. Always: box half-sides 15-75 mm in the pad plane and 5-30 mm along the
/// closing direction, mass 0.02-1 kg and grip force 5-100 N (log-uniform), rectangular
/// pads of half-sides 3-12 mm turned at random, centre of mass up to a fifth of the box
/// off its middle, pads anywhere on the box, gravity in any direction of the pad plane,
/// and a pusher on one of the four faces that are not gripped: a point, a line in any
/// direction of the face, or a rectangle; off the mid-plane by up to half the half-width,
/// moving within 60 degrees of the normal at 10 mm/s.
struct SpatialRange {
  int points_per_pad = 8;  ///< 1, 2, 4, 8, 16, 32 or 64 (Gauss products)
  int pusher_points = 0;   ///< 1 point, 2 line, 4 plane, or 0: any
  JawMode jaw_mode = JawMode::kCoupled;
  double acceleration = 0.0;  ///< rates become accelerations of this size
                              ///< [m/s^2]; 0: quasi-static
  double friction_low = 0.2;  ///< of the pads
  double friction_high = 1.0;
  double pusher_friction_low = 0.1;
  double pusher_friction_high = 0.9;
  PressureLaw pressure = PressureLaw::kFoundation;  ///< of the pads
  double compliance = 1e-2;   ///< of foundations, in units V0 / F0; a plane pusher
                              ///< rests on one too, without preload
  double spin_radius = 0.0;   ///< [m] of every pad point
  double out_of_plane = 1.0;  ///< 0: gravity, pusher and push lie in the mid-plane
                              ///< and the pads are alike (the planar problem)
};

SpatialProblem random_spatial(std::uint64_t seed, std::uint64_t index,
                              const SpatialRange& range = {});

/// Pads that face each other and a pusher in the mid-plane, as a planar problem: the
/// instant that `random_spatial` draws with `out_of_plane` 0.
struct PlanarEquivalent {
  PlanarGrasp grasp;
  PlanarDrive drive;
};
PlanarEquivalent planar_equivalent(const SpatialProblem& problem);

}  // namespace prehensile
