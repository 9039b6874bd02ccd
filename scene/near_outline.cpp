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
    if (count_ < kMostNear) near_[count_] = {a, b, squared_distance};
    ++count_;
  }
}

double NearOutline::depth_at(const Vec2& p, double within) const noexcept {
  if (count_ > kMostNear) return depth_inside(outline_, p);
  double squared_distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count_; ++k) {
    const Edge& edge = near_[k];
    if (edge.squared_distance > within * within) continue;
    squared_distance =
        std::min(squared_distance, squared_distance_to_segment(p, edge.a, edge.b));
  }
  const double distance = std::sqrt(squared_distance);
  return is_inside(outline_, p) ? distance : -distance;
}

const NearOutline::Edge* NearOutline::only_edge_at(const Vec2& p, double distance,
                                                   double within) const noexcept {
  const Edge* only = nullptr;
  for (std::size_t k = 0; count_ <= kMostNear && k < count_; ++k) {
    const Edge& edge = near_[k];
    if (edge.squared_distance > within * within) continue;
    if (squared_distance_to_segment(p, edge.a, edge.b) >= distance * distance) continue;
    if (only) return nullptr;
    only = &edge;
  }
  return only;
}

}  // namespace prehensile
