/// How far the push force may vary while the motion stays: forces of points that stick,
/// and loads of rigid patches, are not determined by the motion. Internal to the
/// mechanics layer.
///
/// The forces that fit a motion form a convex set (rays of sliding points, discs and
/// cones of sticking ones, joined by the balance); the sum of the pusher's normal forces
/// is linear on it. Its ends are found by the proximal point method of Rockafellar 1976
/// in the space of rates, the dual of the balance.
#pragma once

#include "mechanics/spatial_kernels.h"

namespace prehensile {

struct ForceInterval {
  bool free_forces = false;  ///< pads leave forces open; otherwise low = high
  bool found = false;        ///< low and high are converged
  double low = 0.0;          ///< sum of the pusher's normal forces, units of force
  double high = 0.0;         ///< infinite where the object can be wedged
};

/// `v` and `forces` are a solution.
ForceInterval force_interval(const ScaledSpatial& problem, const SpatialRates& v,
                             const SpatialForces& forces) noexcept;

}  // namespace prehensile
