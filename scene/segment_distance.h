/// Points and straight segments.
#pragma once

#include <algorithm>

#include "scene/frames.h"

namespace prehensile {

/// Where the segment from a to b, which may be a point, is nearest to p: its share from a
/// on, 0 to 1. All in one frame.
inline double nearest_share(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double squared = d.squaredNorm();
  return squared > 0.0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0.0;
}

/// Distance of p from the segment from a to b, which may be a point: squared [m^2]. All
/// in one frame.
inline double squared_distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  return (p - a - nearest_share(p, a, b) * (b - a)).squaredNorm();
}

}  // namespace prehensile
