/// A push that was made and measured, and what the mechanics says about it.
///
/// Seen from the hand the pusher went from one place to another, and the object from one
/// pose to another. The pusher is taken to have gone straight (if it turned: as a
/// LinearPush does) and to have met the face from the place where its path crosses it on;
/// a line lies flush on the face then.
#pragma once

#include <limits>
#include <optional>

#include "primitives/transition.h"

namespace prehensile {

struct MeasuredPush {
  int pusher = 0;  ///< index in Scene::pushers
  int face = -1;   ///< index in Model::faces; -1: the one that the path meets first
  PlanarPose X_HO_start, X_HO_end;
  Vec2 from = Vec2::Zero();  ///< [m] centre of the pusher in H, at its start
  Vec2 to = Vec2::Zero();    ///< [m] and at its end
  double turn = 0.0;         ///< [rad] of the pusher in the hand over the path
  /// [N] greatest force of the pusher on the way; unset: not measured.
  std::optional<double> push_force;
  std::optional<double> grip_force;  ///< [N] of each finger; unset: that of the scene
};

struct PredictedPush {
  PlanarPose X_HO_end;  ///< where the object was left, also by a push that ended early
  double push_force = std::numeric_limits<double>::quiet_NaN();  ///< [N] greatest
  TransitionStatus status = TransitionStatus::kNotRun;  ///< so if the pusher misses
};

/// The push as the planner would state it, with the pusher displaced by `registration`
/// [m, in H]: its contact, place on the face, direction, travel and turn. Nothing where
/// the path meets no face that this pusher may touch. A path that begins inside the
/// object is prolonged backwards to the face.
std::optional<LinearPush> push_of(const Model& model, const MeasuredPush& measured,
                                  const Vec2& registration) noexcept;

/// The grip force is that of the model, not that of the measurement.
PredictedPush predict(const Model& model, const MeasuredPush& measured,
                      const Vec2& registration,
                      const TransitionOptions& options = {}) noexcept;

}  // namespace prehensile
