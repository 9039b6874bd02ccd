/// Measures of pushes that several tests need.
#pragma once

#include "primitives/transition.h"
#include "problems/random_pushes.h"

namespace prehensile::testing {

inline bool has_event(const Transition& transition, EventKind kind) {
  for (int i = 0; i < transition.event_count; ++i) {
    if (transition.events[i].kind == kind) return true;
  }
  return false;
}

/// Distance of two poses [m]; angles weigh c.
inline double distance(const PlanarPose& one, const PlanarPose& other, double c) {
  return Vec3(one.x - other.x, one.y - other.y, c * (one.theta - other.theta)).norm();
}

/// The same push mirrored in the x axis of the hand and of the object.
inline RandomPush mirrored(RandomPush c) {
  const auto flip = [](Vec2& v) { v.y() = -v.y(); };
  flip(c.scene.g_W);
  c.scene.pushers[0].normal_angle *= -1.0;
  c.push.place *= -1.0;
  flip(c.push.e);
  c.push.turn *= -1.0;
  c.push.bend *= -1.0;
  c.scene.start.X_HO.y *= -1.0;
  c.scene.start.X_HO.theta *= -1.0;
  return c;
}

}  // namespace prehensile::testing
