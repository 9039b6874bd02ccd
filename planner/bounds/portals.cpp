#include "planner/bounds/portals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/segment.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

bool on_side(const std::vector<Vec2>& outline, std::size_t from, std::size_t to,
             const Vec2& origin, const Vec2& normal) {
  for (std::size_t i = from; i != to; i = (i + 1) % outline.size()) {
    if (normal.dot(outline[i] - origin) < -1e-9) return false;
  }
  return true;
}

bool parts(const std::vector<Vec2>& outline, std::size_t i, std::size_t j,
           const Vec2& normal) {
  return (on_side(outline, i, j, outline[i], normal) &&
          on_side(outline, j, i, outline[i], -normal)) ||
         (on_side(outline, i, j, outline[i], -normal) &&
          on_side(outline, j, i, outline[i], normal));
}

}  // namespace

std::vector<Portal> portals_of(const std::vector<Vec2>& outline) {
  constexpr std::size_t kMostVertices = 64;
  std::vector<Portal> portals;
  const std::size_t n = outline.size();
  if (n > kMostVertices) return portals;
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_reflex(outline, i)) continue;
    Portal best;
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i || (j + 1) % n == i || (i + 1) % n == j) continue;
      const Vec2 along = outline[j] - outline[i];
      const Vec2 normal = perp(along).normalized();
      if (along.norm() >= length || !parts(outline, i, j, normal)) continue;
      if (!segment_inside(outline, outline[i], outline[j])) continue;
      length = along.norm();
      best = {outline[i], outline[j], normal};
    }
    const bool known = std::any_of(portals.begin(), portals.end(), [&](const Portal& p) {
      return p.from == best.to && p.to == best.from;
    });
    if (std::isfinite(length) && !known) portals.push_back(best);
  }
  return portals;
}

}  // namespace prehensile
