/// Straight segments in an outline, for the path of the finger axis in the object.
#pragma once

#include <vector>

#include "scene/frames.h"

namespace prehensile {

/// The whole segment p q lies in the closed polygon; p == q allowed. Any simple outline
/// of at most 256 edges; false beyond that. No heap.
bool segment_inside(const std::vector<Vec2>& outline, const Vec2& p,
                    const Vec2& q) noexcept;

/// Least distance [m] between the segment p q and the border of the outline; meaningful
/// for a segment inside, where the two do not cross. No heap.
double distance_to_border(const std::vector<Vec2>& outline, const Vec2& p,
                          const Vec2& q) noexcept;

struct Extent {
  double low, high;  ///< [m]
};

/// Least and greatest `across`.p of the outline where low <= `along`.p <= high [m]; the
/// two vectors are a unit basis. Infinite, low above high, where there is none. No heap.
Extent extent_across(const std::vector<Vec2>& outline, const Vec2& along,
                     const Vec2& across, double low, double high) noexcept;

}  // namespace prehensile
