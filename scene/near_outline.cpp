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
  sides_ = sides_that_tell(is_convex);
}

// What no other edge comes near to is a half-plane, or lies about one corner; and what is
// right of any edge of a convex outline is outside.
NearOutline::Sides NearOutline::sides_that_tell(bool is_convex) const noexcept {
  if (count_ == 1 || (is_convex && count_ > 0)) return Sides::kLeftOfAll;
  if (count_ != 2) return Sides::kTellNothing;
  const bool in_order = near_[0].b == near_[1].a;
  if (!in_order && near_[1].b != near_[0].a) return Sides::kTellNothing;
  const Edge& in = near_[in_order ? 0 : 1];
  const Edge& out = near_[in_order ? 1 : 0];
  const double turn = cross(in.b - in.a, out.b - out.a);
  return turn > 0.0   ? Sides::kLeftOfAll
         : turn < 0.0 ? Sides::kLeftOfAny
                      : Sides::kTellNothing;
}

NearOutline::Close NearOutline::close_to_any(const Vec2& p, double distance,
                                             double within) const noexcept {
  if (count_ > kMostNear) {
    const double depth = depth_inside(outline_, p);
    return {std::abs(depth) < distance ? 3 : 0, nullptr, nullptr, depth > 0.0};
  }
  Close close;
  bool left_of_all = true;
  bool left_of_any = false;
  for (std::size_t k = 0; k < count_; ++k) {
    const Edge& edge = near_[k];
    const double area = cross(edge.b - edge.a, p - edge.a);
    if (area > 0.0) {
      left_of_any = true;
    } else {
      left_of_all = false;
    }
    if (edge.squared_distance > within * within) continue;
    // Most edges are farther by their line already.
    if (area * area > distance * distance * edge.squared_length) continue;
    if (squared_distance_to_segment(p, edge.a, edge.b) >= distance * distance) continue;
    if (close.count == 2) return {3};
    (close.count == 0 ? close.one : close.two) = &edge;
    ++close.count;
  }
  if (close.count > 0) return close;
  close.inside = sides_ == Sides::kLeftOfAll   ? left_of_all
                 : sides_ == Sides::kLeftOfAny ? left_of_any
                                               : is_inside(outline_, p);
  return close;
}

}  // namespace prehensile
