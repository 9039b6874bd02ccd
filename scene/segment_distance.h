/// How far a point is from a straight segment.
#pragma once

#include <algorithm>

#include "scene/frames.h"

namespace prehensile {

/// Of p from the segment from a to b, which may be a point: squared [m^2]. All in one
/// frame.
inline double squared_distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double squared = d.squaredNorm();
  const double share =
      squared > 0.0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0.0;
  return (p - a - share * d).squaredNorm();
}

}  // namespace prehensile
