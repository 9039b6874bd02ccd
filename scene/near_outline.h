/// An outline as it looks from near one place: for many questions about points there.
/// Internal to the scene layer.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "scene/frames.h"

namespace prehensile {

/// By crossings of a ray; either, on the border.
bool is_inside(const std::vector<Vec2>& outline, const Vec2& p);

/// An outline and the distance of its edges from one place; no heap. The outline must
/// outlive it.
class NearOutline {
 public:
  /// Counter-clockwise. Edges farther away than `radius` [m] are left out.
  NearOutline(const std::vector<Vec2>& outline, bool is_convex, const Vec2& centre,
              double radius) noexcept;

  /// What sides of the edges nearby a place inside is on: left of all; or, at a corner
  /// that turns right, of any.
  enum class Sides { kTellNothing, kLeftOfAll, kLeftOfAny };
  Sides sides() const { return sides_; }

  struct Edge {
    Vec2 a, b;
    double squared_length;    ///< [m^2]
    double squared_distance;  ///< [m^2] from the centre
  };

  /// Edges of the outline that are closer than some distance to a point.
  struct Close {
    int count = 0;              ///< 3: three or more, or some of too many nearby
    const Edge* one = nullptr;  ///< where there are one or two
    const Edge* two = nullptr;  ///< where there are two
    bool inside = false;        ///< where there is none: whether the point is
  };

  /// Those closer than `distance` to p, all of which must be no farther than `within`
  /// from the centre.
  Close close_to(const Vec2& p, double distance, double within) const noexcept {
    if (count_ == 1) {  // mostly, and mostly farther by its line already
      const Edge& edge = near_[0];
      const double area = cross(edge.b - edge.a, p - edge.a);
      if (area * area > distance * distance * edge.squared_length) {
        return {0, nullptr, nullptr, area > 0.0};
      }
    }
    return close_to_any(p, distance, within);
  }

 private:
  Close close_to_any(const Vec2& p, double distance, double within) const noexcept;

  static constexpr std::size_t kMostNear = 32;  // where there are more, all are looked at

  Sides sides_that_tell(bool is_convex) const noexcept;

  const std::vector<Vec2>& outline_;
  std::array<Edge, kMostNear> near_;
  std::size_t count_ = 0;
  Sides sides_ = Sides::kTellNothing;
};

}  // namespace prehensile
