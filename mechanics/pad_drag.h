/// Friction of the points of a pad under a twist. Internal to the mechanics layer.
#pragma once

#include <cmath>

#include "scene/frames.h"

namespace prehensile {

struct PadDrag {
  Vec2 force = Vec2::Zero();
  double moment = 0.0;  ///< [m] times the unit of force, about the finger axis
};

/// Wrench that overcomes the friction of `count` points at (x, y), moved away from the
/// finger axis by `stretch`, each with friction force at most `bound`, for a twist of the
/// object (velocity at the finger axis, omega) of any scale. A point at rest adds
/// nothing.
template <class Column>
PadDrag drag_of_points(int count, const Column& x, const Column& y, const Column& bound,
                       double stretch, const Vec2& velocity, double omega) noexcept {
  PadDrag drag;
  for (int j = 0; j < count; ++j) {
    const Vec2 r = stretch * Vec2(x[j], y[j]);
    const Vec2 slip = velocity + omega * perp(r);
    const double speed = slip.norm();
    if (speed == 0.0) continue;
    const Vec2 f = bound[j] / speed * slip;
    drag.force += f;
    drag.moment += cross(r, f);
  }
  return drag;
}

/// The same of the ellipsoid with torque radius c, over its F.
inline PadDrag drag_of_ellipsoid(double c, const Vec2& velocity, double omega) noexcept {
  const double speed = std::sqrt(velocity.squaredNorm() + c * c * omega * omega);
  return {velocity / speed, c * c * omega / speed};
}

}  // namespace prehensile
