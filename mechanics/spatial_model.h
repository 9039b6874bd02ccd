/// The spatial question that a compiled scene asks at a pose: the pads as patches on both
/// faces of the object, and a pusher that may touch off the mid-plane and move out of the
/// pad plane.
#pragma once

#include "mechanics/model.h"
#include "mechanics/spatial_problem.h"

namespace prehensile {

/// What the pad plane cannot say about a push.
struct OutOfPlane {
  double height = 0.0;  ///< [m] of the pusher along z of H, from the mid-plane
  double rate = 0.0;    ///< [m/s] of the pusher along z of H
  /// Compliance of the pads' foundations in units V0 / F0, > 0: elastic deflection over
  /// travel of the pusher. Small is stiff; 1e-3 is within a per mille of rigid pads.
  double compliance = 1e-3;
};

/// The quasi-static question for this contact at a pose: `place` as in
/// PushContact::segment, `V_HP` the pusher's twist in the pad plane. The centre of mass
/// lies in the mid-plane. No points (count 0) where the pads have lost the face, or where
/// they and the pusher have more than SpatialProblem::kMaxPoints. No heap.
SpatialProblem spatial_problem_at(const Model& model, const PushContact& contact,
                                  double place, const PlanarPose& X_HO,
                                  const PlanarTwist& V_HP,
                                  const OutOfPlane& out_of_plane = {}) noexcept;

}  // namespace prehensile
