#include "planner/geometry/segment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/constants.h"
#include "scene/outline.h"
#include "scene/segment_distance.h"

namespace prehensile {
namespace {

/// How far beyond its ends, as a share, an edge is still cut. Generous: a cut too many
/// only means one more point to look at.
constexpr double kReach = 1e-6;
constexpr std::size_t kMostCuts = 256;

/// Where a segment meets edges of the outline, as shares of its length.
struct Cuts {
  std::size_t count = 0;
  std::array<double, kMostCuts> shares;
};

Cuts cuts_of(const std::vector<Vec2>& outline, const Vec2& p, const Vec2& q) {
  Cuts cuts;
  const Vec2 along = q - p;
  for (std::size_t i = 0; i < outline.size() && cuts.count < kMostCuts; ++i) {
    const Vec2& a = outline[i];
    const Vec2 edge = outline[(i + 1) % outline.size()] - a;
    const double det = cross(along, edge);
    if (det == 0.0) continue;  // its neighbours cut where it begins and ends
    const double share = cross(a - p, edge) / det;
    const double on_edge = cross(a - p, along) / det;
    const bool meets = on_edge >= -kReach && on_edge <= 1.0 + kReach;
    if (!meets || share < -kReach || share > 1.0 + kReach) continue;
    cuts.shares[cuts.count++] = std::clamp(share, 0.0, 1.0);
  }
  return cuts;
}

}  // namespace

bool segment_inside(const std::vector<Vec2>& outline, const Vec2& p,
                    const Vec2& q) noexcept {
  if (outline.size() > kMostCuts || !contains(outline, p)) return false;
  Cuts cuts = cuts_of(outline, p, q);
  if (cuts.count == 0 && p != q) return true;
  if (!contains(outline, q)) return false;
  // Between two cuts the segment is either inside or outside: its middle tells.
  const auto end = cuts.shares.begin() + static_cast<std::ptrdiff_t>(cuts.count);
  std::sort(cuts.shares.begin(), end);
  double from = 0.0;
  for (std::size_t i = 0; i <= cuts.count; ++i) {
    const double to = i < cuts.count ? cuts.shares[i] : 1.0;
    if (to > from && !contains(outline, p + 0.5 * (from + to) * (q - p))) return false;
    from = to;
  }
  return true;
}

double distance_to_border(const std::vector<Vec2>& outline, const Vec2& p,
                          const Vec2& q) noexcept {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    squared = std::min({squared, squared_distance_to_segment(a, p, q),
                        squared_distance_to_segment(p, a, b),
                        squared_distance_to_segment(q, a, b)});
  }
  return std::sqrt(squared);
}

Extent extent_across(const std::vector<Vec2>& outline, const Vec2& along,
                     const Vec2& across, double low, double high) noexcept {
  Extent extent{kInfinity, -kInfinity};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& p = outline[i];
    const Vec2 d = outline[(i + 1) % outline.size()] - p;
    const double at = along.dot(p);
    const double rise = along.dot(d);
    double first = 0.0, last = 1.0;  // shares of the edge between the two lines
    if (rise != 0.0) {
      const auto [near, far] = std::minmax({(low - at) / rise, (high - at) / rise});
      first = std::max(first, near);
      last = std::min(last, far);
    } else if (at < low || at > high) {
      continue;
    }
    if (first > last) continue;
    for (const double share : {first, last}) {
      const double value = across.dot(p + share * d);
      extent.low = std::min(extent.low, value);
      extent.high = std::max(extent.high, value);
    }
  }
  return extent;
}

}  // namespace prehensile
