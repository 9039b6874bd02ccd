#include "planner/geometry/inner_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/segment.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

/// Of way-points from the corner that they turn about, over the outline's longer side.
constexpr double kAway = 0.01;

double turn_at(const std::vector<Vec2>& outline, std::size_t i) {
  const std::size_t n = outline.size();
  const Vec2 in = outline[i] - outline[(i + n - 1) % n];
  const Vec2 out = outline[(i + 1) % n] - outline[i];
  return cross(in, out);
}

double signed_area(const std::vector<Vec2>& outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    twice += cross(outline[i], outline[(i + 1) % outline.size()]);
  }
  return 0.5 * twice;
}

/// Points just inside the reflex corners, where a shortest path may turn.
std::vector<Vec2> turning_points(const std::vector<Vec2>& outline) {
  const double side = signed_area(outline) > 0.0 ? 1.0 : -1.0;
  const double away = kAway * longer_side(outline);
  const std::size_t n = outline.size();
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < n; ++i) {
    if (side * turn_at(outline, i) >= 0.0) continue;
    const Vec2 to_last = (outline[(i + n - 1) % n] - outline[i]).normalized();
    const Vec2 to_next = (outline[(i + 1) % n] - outline[i]).normalized();
    const Vec2 outwards = to_last + to_next;
    if (outwards.norm() < 1e-9) continue;
    points.push_back(outline[i] - away * outwards.normalized());
  }
  return points;
}

}  // namespace

std::vector<Vec2> inner_path(const std::vector<Vec2>& outline, const Vec2& p,
                             const Vec2& q) {
  if (segment_inside(outline, p, q)) return {p, q};
  std::vector<Vec2> points = turning_points(outline);
  points.insert(points.begin(), p);
  points.push_back(q);
  const std::size_t last = points.size() - 1;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> length(points.size(), kFar);
  std::vector<std::size_t> from(points.size(), 0);
  std::vector<bool> done(points.size(), false);
  length[0] = 0.0;
  for (std::size_t round = 0; round < points.size(); ++round) {  // Dijkstra
    std::size_t next = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (done[i] || length[i] == kFar) continue;
      if (next == points.size() || length[i] < length[next]) next = i;
    }
    if (next == points.size() || next == last) break;
    done[next] = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double longer = length[next] + (points[i] - points[next]).norm();
      if (done[i] || longer >= length[i]) continue;
      if (!segment_inside(outline, points[next], points[i])) continue;
      length[i] = longer;
      from[i] = next;
    }
  }
  if (length[last] == kFar) return {};
  std::vector<Vec2> path = {points[last]};
  for (std::size_t i = last; i != 0; i = from[i]) path.push_back(points[from[i]]);
  std::reverse(path.begin(), path.end());
  return path;
}

double path_length(const std::vector<Vec2>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

std::vector<Vec2> cut_path(const std::vector<Vec2>& path, int pieces) {
  const double total = path_length(path);
  std::vector<Vec2> points = {path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = (path[i] - path[i - 1]).norm();
    const double share_of_path = total > 0.0 ? length / total : 1.0;
    const int parts = std::max(1, static_cast<int>(std::lround(pieces * share_of_path)));
    for (int k = 1; k <= parts; ++k) {
      const double share = static_cast<double>(k) / parts;
      points.push_back(path[i - 1] + share * (path[i] - path[i - 1]));
    }
  }
  return points;
}

}  // namespace prehensile
