#include "scene/near_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/outline.h"
#include "scene/segment_distance.h"

namespace prehensile {

bool is_inside(const std::vector<Vec2>& outline, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
    const Vec2& a = outline[before];
    const Vec2& b = outline[i];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (p.x() < x) inside = !inside;
  }
  return inside;
}

NearOutline::NearOutline(const std::vector<Vec2>& outline, const Vec2& centre,
                         double radius) noexcept
    : outline_(outline) {
  for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
    const Vec2& a = outline[before];
    const Vec2& b = outline[i];
    const double squared_distance = squared_distance_to_segment(centre, a, b);
    if (squared_distance > radius * radius) continue;
    if (count_ < kMostNear) {
      near_[count_] = {a, b, (b - a).squaredNorm(), squared_distance};
    }
    ++count_;
  }
}

NearOutline::Close NearOutline::close_to(const Vec2& p, double distance,
                                         double within) const noexcept {
  if (count_ > kMostNear) {
    return {std::abs(depth_inside(outline_, p)) < distance ? 2 : 0, nullptr};
  }
  Close close;
  for (std::size_t k = 0; k < count_; ++k) {
    const Edge& edge = near_[k];
    if (edge.squared_distance > within * within) continue;
    // Most edges are farther by their line already.
    const double area = cross(edge.b - edge.a, p - edge.a);
    if (area * area > distance * distance * edge.squared_length) continue;
    if (squared_distance_to_segment(p, edge.a, edge.b) >= distance * distance) continue;
    if (close.count == 1) return {2, nullptr};
    close = {1, &edge};
  }
  return close;
}

}  // namespace prehensile
