/// Where things stand in the world while a pusher touches the object. Internal to the
/// planner.
#pragma once

#include "mechanics/model.h"

namespace prehensile {

/// Pose of O in W while a contact is flush, the pusher's centre at `place` along the
/// face.
PlanarPose object_at_pusher(const Model& model, const PushContact& contact, double place);

/// How far from the middle of its face a pusher may stand where that matters, among
/// obstacles and limits on the hand [m]: so far that it stands on the face whole, or
/// covers it; 0 where its ends are not known.
double farthest_place(const PushContact& contact);

/// Pose of H in W, with the finger axis at p_OF and O at the angle theta in H.
inline PlanarPose hand_in_world(const PlanarPose& X_WO, const Vec2& p_OF, double theta) {
  const Vec2 p_WF = transform(X_WO, p_OF);
  return {p_WF.x(), p_WF.y(), X_WO.theta - theta};
}

}  // namespace prehensile
