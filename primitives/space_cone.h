/// The motion cone of a pusher where the loads of the pads shift: no closed form carries
/// over, so its border is found by spatial instants.
#pragma once

#include "primitives/motion_cone.h"

namespace prehensile {

struct SpatialVerdict {
  bool is_known = false;  ///< the instant has one answer
  double margin = -1.0;   ///< >= 0: sticks; dimensionless, through zero at the border
};

/// Whether the object follows the pusher that moves as in `sticks`, by the spatial
/// instant with the real pads; up to what these yield (spatial_push_instant.h). A motion
/// that leaves the pad plane is not followed. No heap.
SpatialVerdict sticks_in_space(const Model& model, const Grasp& grasp, int contact,
                               double place, double direction,
                               double omega_per_speed) noexcept;

/// The cone of the pad plane made one of space, with the same slices: the nominal part by
/// instants, the robust part as far as it lies in that. Rates of turn narrower than a
/// twentieth of the range of atan(c omega / speed) may be missed. A second or so.
MotionCone cone_in_space(const Model& model, const Grasp& grasp, int contact,
                         double place, const MotionCone& flat);

}  // namespace prehensile
