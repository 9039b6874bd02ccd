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
  /// Edges farther away than `radius` [m] are left out.
  NearOutline(const std::vector<Vec2>& outline, const Vec2& centre,
              double radius) noexcept;

  struct Edge {
    Vec2 a, b;
    double squared_length;    ///< [m^2]
    double squared_distance;  ///< [m^2] from the centre
  };

  /// Edges of the outline that are closer than some distance to a point.
  struct Close {
    int count = 0;               ///< 2: two or more, or some of too many nearby
    const Edge* only = nullptr;  ///< where there is one
  };

  /// Those closer than `distance` to p, all of which must be no farther than `within`
  /// from the centre.
  Close close_to(const Vec2& p, double distance, double within) const noexcept;

 private:
  static constexpr std::size_t kMostNear = 32;  // where there are more, all are looked at

  const std::vector<Vec2>& outline_;
  std::array<Edge, kMostNear> near_;
  std::size_t count_ = 0;
};

}  // namespace prehensile
