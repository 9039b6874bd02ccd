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

NearOutline::NearOutline(const std::vector<Vec2>& outline, bool is_convex,
                         const Vec2& centre, double radius) noexcept
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
  sides_tell_ = count_ == 1 || (is_convex && count_ > 0);
}

NearOutline::Close NearOutline::close_to_any(const Vec2& p, double distance,
                                             double within) const noexcept {
  if (count_ > kMostNear) {
    const double depth = depth_inside(outline_, p);
    return {std::abs(depth) < distance ? 2 : 0, nullptr, depth > 0.0};
  }
  Close close;
  close.inside = true;
  for (std::size_t k = 0; k < count_; ++k) {
    const Edge& edge = near_[k];
    const double area = cross(edge.b - edge.a, p - edge.a);
    close.inside = close.inside && area > 0.0;
    if (edge.squared_distance > within * within) continue;
    // Most edges are farther by their line already.
    if (area * area > distance * distance * edge.squared_length) continue;
    if (squared_distance_to_segment(p, edge.a, edge.b) >= distance * distance) continue;
    if (close.count == 1) return {2, nullptr};
    close.count = 1;
    close.only = &edge;
  }
  if (close.count == 0 && !sides_tell_) close.inside = is_inside(outline_, p);
  return close;
}

}  // namespace prehensile
