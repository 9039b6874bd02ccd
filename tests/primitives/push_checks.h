/// Measures of pushes that several tests need.
#pragma once

#include "primitives/transition.h"

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

}  // namespace prehensile::testing
