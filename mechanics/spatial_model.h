/// The spatial question that a compiled scene asks at a pose: the pads as patches on both
/// faces of the object, and a pusher that may touch off the mid-plane and move in any
/// way.
#pragma once

#include <optional>

#include "mechanics/model.h"
#include "mechanics/spatial_problem.h"

namespace prehensile {

/// A twist in the pad plane as a spatial one.
SpatialTwist in_space(const PlanarTwist& V);

/// What the pad plane sees of a twist; exact where the rest is zero.
PlanarTwist in_pad_plane(const SpatialTwist& V);
bool lies_in_pad_plane(const SpatialTwist& V);

struct SpatialQuestionOptions {
  bool from_rest = false;  ///< the pusher's rates are accelerations from rest, and the
                           ///< object has its inertia; else quasi-static
  std::optional<double> height;  ///< [m] of the pusher above the mid-plane instead of the
                                 ///< scene's; a feature with width is moved as a whole
  /// Pads of free pressure rest on foundations instead: of all answers that the free law
  /// allows, the one that a series of instants can follow.
  bool follow_free_pressure = false;
};

/// The question for this contact at a pose: `place` as in PushContact::segment, `V_HP`
/// the pusher's twist (or acceleration). No points (count 0) where the pads have lost the
/// face, where the jaws cannot carry gravity along the closing direction, or where pads
/// and pusher have more points than SpatialProblem::kMaxPoints. No heap.
SpatialProblem spatial_problem_at(const Model& model, const PushContact& contact,
                                  double place, const PlanarPose& X_HO,
                                  const SpatialTwist& V_HP,
                                  const SpatialQuestionOptions& options = {}) noexcept;

/// The same with the points that touch, in the pad plane, and with gravity g_O [m/s^2]
/// in O: the middle of a push, where the object may have turned on the pusher. The
/// drive's twist is the pusher's motion.
SpatialProblem spatial_problem_at(const Model& model, const PushContact& contact,
                                  const PlanarDrive& drive, const PlanarPose& X_HO,
                                  const Vec2& g_O,
                                  const SpatialQuestionOptions& options = {}) noexcept;

}  // namespace prehensile
